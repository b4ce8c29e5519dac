// Pictures and reports of the binary.

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "command.h"
#include "glint/image/read_image.h"
#include "glint/image/srgb.h"
#include "glint/image/stored_image.h"
#include "glint/options/parameters.h"
#include "gltf_text.h"
#include "scenes.h"

namespace glint::test::render_cli_test {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

const std::string sphere = shipped + "sphere.glb", torus = shipped + "torus.glb";

// Draws the sphere with the arguments; returns the bytes of the picture.
std::string picture(const Folder& folder, std::vector<std::string> arguments,
                    const std::string& name = "a.pfm") {
  arguments.insert(arguments.begin(), {"render", sphere, "-o", folder / name});
  expectDone(runGlint(quick(arguments)));
  return contents(folder / name);
}

TEST(Render, WritesPngAndPfmOfTheSamePicture) {
  Folder folder("formats");
  picture(folder, {}, "a.png");
  picture(folder, {"--bit-depth", "16"}, "deep.png");
  picture(folder, {}, "a.pfm");
  picture(folder, {}, "UPPER.PNG");
  EXPECT_EQ(contents(folder / "a.png"), contents(folder / "UPPER.PNG"));
  const glint::Image linear = glint::readImage(folder / "a.pfm"),
                     png = glint::readImage(folder / "a.png"),
                     deep = glint::readImage(folder / "deep.png");
  ASSERT_EQ(linear.width, 40);
  ASSERT_EQ(linear.height, 30);
  ASSERT_EQ(png.values.size(), linear.values.size());
  std::size_t model = 0;
  for (std::size_t i = 0; i < linear.values.size(); ++i) {
    if (i % 4 == 3) continue;
    const float x = linear.values[i];
    EXPECT_EQ(png.values[i], glint::decodeSrgb8(glint::encodeSrgb8(x)));
    EXPECT_EQ(deep.values[i], glint::decodeSrgb16(glint::encodeSrgb16(x)));
    model += x != float(glint::Look{}.backgroundColor.r);
  }
  EXPECT_GT(model, 300u);
}

TEST(Render, WritesAPngToStdout) {
  Folder folder("stdout");
  const std::string file = picture(folder, {}, "a.png");
  const Ran ran = runGlint(quick({"render", sphere, "-o", "-"}));
  expectDone(ran);
  EXPECT_EQ(ran.out, file);
  EXPECT_THAT(ran.out, StartsWith("\x89PNG\r\n\x1a\n"));
}

TEST(Render, EndsQuietlyWhenNobodyReads) {
  const Ran ran = runGlint(quick({"render", sphere, "-o", "-"}), {.closedOut = true});
  // By the signal, like other tools, or with a message; never with a crash or with success.
  EXPECT_FALSE(ran.timedOut);
  if (ran.signal == 0) {
    EXPECT_EQ(ran.status, 2);
    EXPECT_EQ(ran.errorLines().size(), 1u) << ran.err;
  } else {
    EXPECT_EQ(ran.signal, SIGPIPE);
    EXPECT_THAT(ran.err, IsEmpty());
  }
}

TEST(Render, TakesValuesThatBeginWithAMinusAndValuesAfterEquals) {
  Folder folder("minus");
  const std::string spaced =
      picture(folder, {"--camera-position", "-1,2,3", "--camera-azimuth-angle", "-10", "--light",
                       "directional:-1,-1,1", "--camera-focal-point", "-.1,0,0"});
  const std::string joined =
      picture(folder, {"--camera-position=-1,2,3", "--camera-azimuth-angle=-10",
                       "--light=directional:-1,-1,1", "--camera-focal-point=-.1,0,0"});
  EXPECT_EQ(spaced, joined);
  EXPECT_NE(spaced, picture(folder, {"--camera-position", "1,2,3"}));
}

// PFM is before exposure; PNG is multiplied by 2^EV before the encode.
TEST(Render, ExposureScalesByPowersOfTwo) {
  Folder folder("exposure");
  const std::string plain = picture(folder, {});
  EXPECT_EQ(plain, picture(folder, {"--exposure", "-1"}));
  const glint::Image linear = glint::readImage(folder / "a.pfm");
  for (const char* ev : {"-1", "2"}) {
    picture(folder, {"--exposure", ev}, "a.png");
    const glint::Image png = glint::readImage(folder / "a.png");
    const float scale = ev == std::string("2") ? 4.0f : 0.5f;
    for (std::size_t i = 0; i < linear.values.size(); ++i)
      if (i % 4 != 3) {
        ASSERT_EQ(png.values[i], glint::decodeSrgb8(glint::encodeSrgb8(scale * linear.values[i])));
      }
  }
}

// A step of 8-bit codes is 1 / (255 * 12.92) wide at black, after exposure, and wider elsewhere.
TEST(Render, ErrorsInCodesAreThoseOfThePicture) {
  Folder folder("codes");
  const auto chosen = [](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"info", torus, "--json", "-"});
    const Ran ran = runGlint(arguments);
    EXPECT_EQ(ran.status, 0) << ran.err;
    return nlohmann::json::parse(ran.out)["choice"];
  };
  const double step = 1 / (255 * 12.92);
  EXPECT_NEAR(chosen({"--max-error", "1code"})["max-error"].get<double>(), step, 1e-12);
  EXPECT_NEAR(chosen({"--max-error", "2.5code", "--exposure", "3"})["max-error"].get<double>(),
              2.5 * step / 8, 1e-12);
  const nlohmann::json choice = chosen({"--max-error", "40code", "--highlight", "exact"});
  EXPECT_NE(choice["materials"][0]["highlight"], "exact");
  EXPECT_LE(choice["bound"].get<double>(), 40 * step);

  for (const char* exposure : {"0", "2"}) {
    picture(folder, {"--exposure", exposure}, "exact.png");
    picture(folder, {"--exposure", exposure, "--max-error", "3code"}, "a.png");
    const auto codes = [&](const char* name) {
      const glint::StoredImage stored = glint::readStoredImage(folder / name);
      return std::get<std::vector<std::uint8_t>>(stored.values);
    };
    const std::vector<std::uint8_t> exact = codes("exact.png"), near = codes("a.png");
    ASSERT_EQ(exact.size(), near.size());
    for (std::size_t i = 0; i < exact.size(); ++i) ASSERT_LE(std::abs(exact[i] - near[i]), 3) << i;
  }
  for (const char* wrong : {"code", "-1code", "1codes", "nancode"}) {
    const Ran ran = runGlint({"info", torus, "--max-error", wrong});
    EXPECT_EQ(ran.status, 2);
    EXPECT_THAT(ran.errorLines(), ElementsAre(AllOf(StartsWith("glint: --max-error: "),
                                                    HasSubstr(wrong), HasSubstr("Ncode"))));
  }
}

TEST(Render, BackgroundIsWhatIsAskedFor) {
  Folder folder("background");
  const auto corner = [&](std::vector<std::string> arguments) {
    picture(folder, std::move(arguments), "a.png");
    const glint::Image image = glint::readImage(folder / "a.png");
    return std::vector<float>(image.values.begin(), image.values.begin() + 4);
  };
  const float grey = glint::decodeSrgb8(0x33);
  EXPECT_THAT(corner({}), ElementsAre(grey, grey, grey, 1));
  EXPECT_THAT(corner({"--background-color", "#ff8000"}),
              ElementsAre(1, glint::decodeSrgb8(0x80), 0, 1));
  EXPECT_THAT(corner({"--no-background"}), ElementsAre(0, 0, 0, 0));
  // PFM has no alpha: the background is black.
  picture(folder, {"--no-background"});
  EXPECT_EQ(glint::readImage(folder / "a.pfm").values[0], 0);
}

TEST(Render, SeveralModelsByTemplates) {
  Folder folder("several");
  expectDone(runGlint(quick({"render", sphere, torus, "-o", folder / "{n}-{model}.png"})));
  EXPECT_THAT(folder.names(), ElementsAre("0-sphere.png", "1-torus.png"));
  EXPECT_NE(contents(folder / "0-sphere.png"), contents(folder / "1-torus.png"));
  // Each is the same as when drawn separately.
  expectDone(runGlint(quick({"render", torus, "-o", folder / "alone.png"})));
  EXPECT_EQ(contents(folder / "alone.png"), contents(folder / "1-torus.png"));
}

TEST(Render, ASavedLookGivesTheSameBytes) {
  Folder folder("look");
  const std::vector<std::string> arguments{"--shading",
                                           "blinn-phong",
                                           "--material",
                                           "exponent=60,color=0.2,0.4,0.8,specular=0.7",
                                           "--light",
                                           "point:2,3,4:1,0.9,0.8",
                                           "--light",
                                           "camera:0.3,0.3,0.3",
                                           "--camera-azimuth-angle",
                                           "12.3456789",
                                           "--camera-view-angle",
                                           "41",
                                           "--background-color",
                                           "#204060",
                                           "--exposure",
                                           "0.25",
                                           "--ambient-light",
                                           "0.1,0.2,0.30000000000000004",
                                           "--resolution",
                                           "33,44",
                                           "--two-sided",
                                           "--viewer",
                                           "infinite"};
  std::vector<std::string> saving = arguments;
  saving.insert(saving.end(), {"--save-look", folder / "look.json"});
  const std::string drawn = picture(folder, saving, "a.png");
  expectDone(runGlint({"render", sphere, "-o", folder / "b.png", "--look", folder / "look.json",
                       "--rendering-backend", "osmesa"}));
  EXPECT_EQ(drawn, contents(folder / "b.png"));
  // The look saved from it is the same file.
  expectDone(runGlint({"render", sphere, "-o", folder / "b.png", "--look", folder / "look.json",
                       "--save-look", folder / "again.json", "--rendering-backend", "osmesa"}));
  EXPECT_EQ(contents(folder / "look.json"), contents(folder / "again.json"));
  // info saves a look, too.
  const Ran info = runGlint(
      {"info", sphere, "--look", folder / "look.json", "--save-look", folder / "info.json"});
  EXPECT_EQ(info.status, 0);
  EXPECT_EQ(contents(folder / "look.json"), contents(folder / "info.json"));
}

// The reference's own default, no anti-aliasing, gives way to a look's as to the command line's.
TEST(Render, TheReferenceKeepsTheAntiAliasingOfALook) {
  Folder folder("reference_look");
  for (const std::vector<std::string>& given : std::vector<std::vector<std::string>>{
           {}, {"--anti-aliasing", "msaa:4"}, {"--anti-aliasing", "msaa:2"}}) {
    std::vector<std::string> first{"render",
                                   sphere,
                                   "-o",
                                   folder / "a.png",
                                   "--resolution",
                                   "24,24",
                                   "--rendering-backend",
                                   "reference",
                                   "--save-look",
                                   folder / "look.json"};
    first.insert(first.end(), given.begin(), given.end());
    expectDone(runGlint(first));
    expectDone(runGlint({"render", sphere, "-o", folder / "b.png", "--rendering-backend",
                         "reference", "--look", folder / "look.json"}));
    EXPECT_EQ(contents(folder / "a.png"), contents(folder / "b.png"))
        << testing::PrintToString(given);
  }
}

// A picture records its look, which reproduces it.
TEST(Render, ThePictureHoldsItsLook) {
  Folder folder("picture_look");
  for (const char* ending : {".png", ".exr"}) {
    const std::string first = folder / (std::string("a") + ending),
                      again = folder / (std::string("b") + ending);
    const Ran ran =
        runGlint({"render", torus, "-o", first, "--resolution", "33,21", "--shading", "environment",
                  "--material", "ior=1.7,color=0.2,0.4,0.8", "--light", "point:2,3,4:1,0.9,0.8",
                  "--camera-azimuth-angle", "12.3456789", "--exposure", "0.1", "--no-background",
                  "--rendering-backend", "osmesa"});
    expectDone(ran);
    expectDone(
        runGlint({"render", torus, "-o", again, "--look", first, "--rendering-backend", "osmesa"}));
    EXPECT_EQ(contents(first), contents(again));
    const auto text = glint::readPictureText(first);
    EXPECT_THAT(text.at("GL_RENDERER"), HasSubstr("llvmpipe"));
    EXPECT_THAT(text.at("Software"), StartsWith("glint "));
    // As with a look file, options take precedence over it.
    expectDone(runGlint({"render", torus, "-o", again, "--look", first, "--exposure", "1",
                         "--rendering-backend", "osmesa"}));
    EXPECT_NE(contents(first), contents(again));
  }
  const std::string foreign = GLINT_SOURCE_DIR "/docs/programs.png";
  const Ran ran = runGlint({"render", torus, "-o", folder / "c.png", "--look", foreign});
  EXPECT_EQ(ran.status, 2);
  EXPECT_THAT(ran.err, HasSubstr("a picture without a stored look"));
}

TEST(Render, ExrHoldsTheLinearValues) {
  Folder folder("exr");
  picture(folder, {"--exposure", "2"});
  picture(folder, {"--exposure", "2"}, "a.exr");
  const glint::Image pfm = glint::readImage(folder / "a.pfm"),
                     exr = glint::readImage(folder / "a.exr");
  EXPECT_EQ(pfm.values, exr.values);
  // With alpha: the sphere is opaque, its surroundings are transparent.
  picture(folder, {"--no-background"}, "a.exr");
  const glint::Image alpha = glint::readImage(folder / "a.exr");
  EXPECT_EQ(alpha.values[3], 0);
  EXPECT_EQ(alpha.row(15)[4 * 20 + 3], 1);
}

// Straight alpha: where a surface covers part of a pixel, its colour is the surface's own and alpha
// is the coverage. A square of one colour has that colour wherever its coverage is above 0.
TEST(Render, TransparentBackgroundHasStraightColoursAtTheEdges) {
  Folder folder("straight");
  const std::string model = glint::test::writeGltf(
      "square", glint::test::quad(),
      [](nlohmann::json& json) {
        json["extensionsUsed"] = {"KHR_materials_unlit"};
        json["materials"][0] = {
            {"name", "paint"},
            {"extensions", {{"KHR_materials_unlit", nlohmann::json::object()}}},
            {"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 0.25, 0.125, 1}}}}};
      },
      folder.path());
  for (const char* antiAliasing : {"msaa:4", "ssaa:4"})
    for (const char* depth : {"8", "16"}) {
      const Ran ran =
          runGlint({"render", model, "-o", folder / "a.png", "--no-background", "--resolution",
                    "40,40", "--anti-aliasing", antiAliasing, "--bit-depth", depth,
                    "--camera-zoom-factor", "0.7", "--rendering-backend", "osmesa"});
      expectDone(ran);
      const glint::StoredImage stored = glint::readStoredImage(folder / "a.png");
      std::vector<float> rgba(4 * 1600);
      stored.encodedRows(0, 40, rgba.data());
      std::map<float, int> alphas;
      const float codes = depth == std::string("8") ? 255.0f : 65535.0f;
      for (std::size_t i = 0; i < rgba.size(); i += 4) {
        ++alphas[rgba[i + 3]];
        if (rgba[i + 3] == 0) continue;
        // One code of rounding: the mean of equal samples divided by their coverage.
        const float colors[] = {0.5f, 0.25f, 0.125f};
        for (std::size_t c = 0; c < 3; ++c)
          ASSERT_NEAR(rgba[i + c], glint::encodedValue(colors[c]), 1 / codes) << antiAliasing;
      }
      EXPECT_GE(alphas.size(), 4u);
      EXPECT_GT(alphas[0], 400);
      EXPECT_GT(alphas[1], 200);
    }
}

TEST(Render, TurntableGoesRoundToTheRight) {
  Folder folder("turntable");
  expectDone(runGlint(quick(
      {"render", torus, "-o", folder / "{frame}.pfm", "--turntable", "12", "--shading", "flat"})));
  EXPECT_EQ(folder.names().size(), 12u);
  EXPECT_EQ(folder.names().front(), "00.pfm");
  for (const auto& [azimuth, frame] : {std::pair("0", "00"), {"30", "01"}, {"330", "11"}}) {
    expectDone(runGlint(quick({"render", torus, "-o", folder / "one.pfm", "--shading", "flat",
                               "--camera-azimuth-angle", azimuth})));
    EXPECT_EQ(contents(folder / "one.pfm"), contents(folder / (std::string(frame) + ".pfm")));
  }
}

TEST(Render, CommandLineBeatsLookBeatsModelBeatsDefault) {
  Folder folder("precedence");
  std::ofstream(folder / "look.json")
      << R"({"glint-look": 1, "shading": "flat", "exposure": 3, "light": ["directional:0,0,1"],
             "no-lights": true, "resolution": [40, 30], "anti-aliasing": "none",
             "material": {"": {"exponent": 5, "specular": 0.25}}})";
  const auto saved = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"info", sphere, "--look", folder / "look.json",
                                         "--save-look", folder / "saved.json"});
    const Ran ran = runGlint(arguments);
    EXPECT_EQ(ran.status, 0) << ran.err;
    return nlohmann::json::parse(contents(folder / "saved.json"));
  };
  auto look = saved({});
  EXPECT_EQ(look["shading"], "flat");
  EXPECT_EQ(look["exposure"], 3.0);
  EXPECT_EQ(look["light"].size(), 1u);
  look = saved({"--shading", "gouraud", "--exposure", "-1"});
  EXPECT_EQ(look["shading"], "gouraud");
  EXPECT_EQ(look["exposure"], -1.0);
  // Given lights replace the file's, even if the file has none.
  look = saved({"--light", "camera", "--light", "point:1,2,3"});
  EXPECT_EQ(look["light"].size(), 2u);
  EXPECT_EQ(look["no-lights"], false);
  // Flags can be reset.
  look = saved({"--no-lights=false"});
  EXPECT_EQ(look["no-lights"], false);
  // An edit of all materials takes precedence over the file's edit of one.
  look = saved({"--material", "exponent=7"});
  EXPECT_EQ(look["material"][""]["exponent"], 7.0);
  EXPECT_EQ(look["material"][""]["specular"], 0.25);

  // The model's own parameters, unless the look has them; the file's edits of one material, unless
  // the command line edits all.
  const auto shown = [&](const std::vector<std::string>& arguments) {
    std::vector<std::string> all{"info", sphere, "--json", "-"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const Ran ran = runGlint(all);
    EXPECT_EQ(ran.status, 0) << ran.err;
    return nlohmann::json::parse(ran.out)["materials"][0];
  };
  const auto own = shown({});
  EXPECT_NE(own["exponent"], 20.0);  // the default of a material without parameters
  EXPECT_EQ(shown({"--look", folder / "look.json"})["exponent"], 5.0);
  const std::string name = own["name"];
  ASSERT_FALSE(name.empty());
  std::ofstream(folder / "named.json")
      << nlohmann::json{{"glint-look", 1}, {"material", {{name, {{"exponent", 5}, {"ior", 2}}}}}};
  EXPECT_EQ(shown({"--look", folder / "named.json"})["exponent"], 5.0);
  const auto edited = shown({"--look", folder / "named.json", "--material", "exponent=9"});
  EXPECT_EQ(edited["exponent"], 9.0);
  EXPECT_EQ(edited["ior"], 2.0);
}

TEST(Render, LastOfARepeatedOptionCounts) {
  Folder folder("repeated");
  EXPECT_EQ(picture(folder, {"--shading", "flat", "--shading", "gouraud"}),
            picture(folder, {"--shading", "gouraud"}));
}

TEST(Render, ReportsInJson) {
  Folder folder("json");
  const Ran ran =
      runGlint(quick({"render", sphere, torus, "-o", folder / "{model}.png", "--json", "-"}));
  expectDone(ran);
  const auto report = nlohmann::json::parse(ran.out);
  EXPECT_TRUE(report["glint"].is_string());
  EXPECT_EQ(report["backend"], "osmesa");
  for (const char* key : {"vendor", "renderer", "version"})
    EXPECT_FALSE(report["gl"][key].get<std::string>().empty()) << key;
  ASSERT_EQ(report["pictures"].size(), 2u);
  const std::size_t triangles[] = {5040, 6144};
  for (std::size_t i = 0; i < 2; ++i) {
    const auto& p = report["pictures"][i];
    EXPECT_EQ(p["model"], i == 0 ? sphere : torus);
    EXPECT_EQ(p["output"], folder / (i == 0 ? "sphere.png" : "torus.png"));
    EXPECT_EQ(p["status"], 0);
    EXPECT_EQ(p["triangles"], triangles[i]);
    EXPECT_EQ(p["draws"], 1);
    EXPECT_EQ(p["samples"], 1);
    EXPECT_TRUE(p["warnings"].is_array());
    ASSERT_EQ(p["variants"].size(), 1u);
    const auto& v = p["variants"][0];
    EXPECT_EQ(v["program"], "phong");
    EXPECT_TRUE(v["features"].is_array());
    EXPECT_TRUE(v["reasons"].is_object());
    EXPECT_EQ(v["materials"].size(), 1u);
    for (const char* key :
         {"load", "decode", "context", "choose", "compile", "draw", "read", "encode", "total"}) {
      ASSERT_TRUE(p["ms"].contains(key)) << key;
      EXPECT_GE(p["ms"][key].get<double>(), 0) << key;
    }
    EXPECT_GE(p["ms"]["total"].get<double>(), p["ms"]["draw"].get<double>());
  }
  // Samples per pixel for each anti-aliasing.
  const std::pair<const char*, int> samples[] = {{"none", 1}, {"msaa:4", 4}, {"ssaa:3", 9}};
  for (const auto& [antiAliasing, count] : samples) {
    const Ran r =
        runGlint({"render", sphere, "-o", folder / "s.png", "--json", "-", "--resolution", "8,8",
                  "--rendering-backend", "osmesa", "--anti-aliasing", antiAliasing});
    EXPECT_EQ(nlohmann::json::parse(r.out)["pictures"][0]["samples"], count) << antiAliasing;
  }
}

TEST(Render, BothBackendsGiveTheSameFiles) {
  Folder folder("backends");
  for (const char* antiAliasing : {"msaa:4", "none"})
    for (const char* ending : {".png", ".pfm"}) {
      for (const char* backend : {"osmesa", "egl-software"})
        expectDone(runGlint({"render", torus, "-o", folder / (std::string(backend) + ending),
                             "--resolution", "60,50", "--anti-aliasing", antiAliasing, "--shading",
                             "environment", "--rendering-backend", backend}));
      EXPECT_EQ(contents(folder / (std::string("osmesa") + ending)),
                contents(folder / (std::string("egl-software") + ending)));
    }
}

TEST(Render, TakesShadersFromAFolder) {
  Folder folder("glsl_override");
  std::ofstream(folder / "phong.glsl") << "#if !VERTEX_STAGE\nvec3 shade(vec4 base) {\n"
                                          "  return vec3(0.0, 1.0, 0.0);\n}\n#endif\n";
  picture(folder, {"--glsl", folder.path()});
  const glint::Image image = glint::readImage(folder / "a.pfm");
  const float* p = image.row(15) + 4 * 20;
  EXPECT_THAT(std::vector<float>(p, p + 3), ElementsAre(0, 1, 0));
}

TEST(Render, NothingToDrawIsTheBackgroundAndAWarning) {
  Folder folder("nothing");
  std::ofstream(folder / "none.gltf") << R"({"asset": {"version": "2.0"}})";
  const Ran ran = runGlint(quick({"render", folder / "none.gltf", "-o", folder / "a.png"}));
  EXPECT_EQ(ran.status, 0);
  ASSERT_EQ(ran.errorLines().size(), 1u) << ran.err;
  EXPECT_THAT(ran.err, AllOf(HasSubstr("warning"), HasSubstr("nothing to draw")));
  const glint::Image image = glint::readImage(folder / "a.png");
  for (std::size_t i = 0; i < image.values.size(); i += 4)
    ASSERT_EQ(image.values[i], glint::decodeSrgb8(0x33));
}

TEST(Render, NeedsNoHome) {
  Folder folder("home");
  const glint::test::CommandOptions nobody{
      .environment = {{"HOME", ""}, {"USER", ""}, {"XDG_CACHE_HOME", ""}, {"XDG_RUNTIME_DIR", ""}}};
  for (const char* backend : {"osmesa", "egl-software"}) {
    const Ran ran = runGlint({"render", sphere, "-o", folder / "a.png", "--resolution", "16,16",
                              "--rendering-backend", backend},
                             nobody);
    expectDone(ran);
  }
}

TEST(Render, WritesWhereItStands) {
  Folder folder("relative");
  expectDone(runGlint(quick({"render", sphere, "-o", "a.png"}), {.folder = folder.path()}));
  EXPECT_THAT(folder.names(), ElementsAre("a.png"));
}

TEST(Help, ListsEveryOptionOfTheTable) {
  for (const char* command : {"render", "info"}) {
    const Ran ran = runGlint({command, "--help"});
    expectDone(ran);
    for (const glint::Parameter& p : glint::lookParameters())
      EXPECT_THAT(ran.out, HasSubstr("--" + p.name)) << command;
    for (const char* option : {"--look", "--save-look", "--json", "--help"})
      EXPECT_THAT(ran.out, HasSubstr(option)) << command;
    std::istringstream lines(ran.out);
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80u) << line;
  }
  EXPECT_THAT(runGlint({"render", "--help"}).out,
              AllOf(HasSubstr("--output"), HasSubstr("--bit-depth"), HasSubstr("--glsl"),
                    HasSubstr("--rendering-backend")));
}

TEST(Help, OfTheProgramListsTheCommands) {
  const Ran ran = runGlint({"--help"});
  expectDone(ran);
  EXPECT_THAT(ran.out, AllOf(HasSubstr("render"), HasSubstr("info"), HasSubstr("backends")));
  const Ran version = runGlint({"--version"});
  expectDone(version);
  EXPECT_THAT(version.out, testing::MatchesRegex("glint [0-9]+\\.[0-9]+\\.[0-9]+\n"));
}

TEST(Info, SaysWhatIsInAModelAndWhichVariantsItNeeds) {
  const Ran text = runGlint({"info", sphere});
  expectDone(text);
  EXPECT_THAT(text.out, AllOf(HasSubstr("5040 triangles"), HasSubstr("phong"),
                              HasSubstr("directional-lights")));
  const Ran ran = runGlint({"info", sphere, "--json", "-", "--shading", "gouraud"});
  expectDone(ran);
  const auto json = nlohmann::json::parse(ran.out);
  EXPECT_EQ(json["model"], "sphere");
  EXPECT_EQ(json["triangles"], 5040);
  EXPECT_EQ(json["meshes"], 1);
  EXPECT_EQ(json["instances"], 1);
  EXPECT_NEAR(json["radius"].get<double>(), 1, 1e-6);
  EXPECT_EQ(json["materials"].size(), 1u);
  EXPECT_EQ(json["variants"][0]["program"], "gouraud");
  EXPECT_FALSE(json["variants"][0]["reasons"].empty());
  EXPECT_TRUE(json["warnings"].empty());
}

TEST(Info, SaysWhatBecomesOfExtensionsSkinsAndMorphTargets) {
  const std::string models = GLINT_SOURCE_DIR "/models/";
  const Ran lights = runGlint({"info", models + "lights.glb"});
  expectDone(lights);
  EXPECT_THAT(lights.out, HasSubstr("KHR_lights_punctual: read (with an exposure"));
  const Ran bend = runGlint({"info", models + "bend.glb"});
  expectDone(bend);
  EXPECT_THAT(bend.out, HasSubstr("0: Rod, 4 joints: Joint 0, Joint 1, Joint 2, Joint 3\n"));
  const Ran morph = runGlint({"info", models + "morph.glb", "--json", "-"});
  expectDone(morph);
  const auto json = nlohmann::json::parse(morph.out);
  EXPECT_EQ(json["morphs"],
            nlohmann::json::parse(R"([{"mesh": "Ball", "targets": ["Tall", "Cube"]}])"));
  EXPECT_TRUE(json["skins"].empty());
  EXPECT_TRUE(json["extensions"].empty());
  const auto extensions = nlohmann::json::parse(
      runGlint({"info", models + "lights.glb", "--json", "-"}).out)["extensions"];
  ASSERT_EQ(extensions.size(), 1u);
  EXPECT_EQ(extensions[0]["name"], "KHR_lights_punctual");
  EXPECT_EQ(extensions[0]["use"], "read");
  EXPECT_EQ(extensions[0]["required"], false);
}

TEST(Backends, AreListedInTextAndJson) {
  const Ran text = runGlint({"backends"});
  expectDone(text);
  EXPECT_THAT(text.out, AllOf(HasSubstr("egl"), HasSubstr("egl-software"), HasSubstr("osmesa"),
                              HasSubstr("works")));
  const Ran ran = runGlint({"backends", "--json", "-"});
  expectDone(ran);
  const auto json = nlohmann::json::parse(ran.out);
  ASSERT_EQ(json.size(), 3u);
  EXPECT_EQ(json[0]["name"], "egl");
  EXPECT_EQ(json[1]["name"], "egl-software");
  EXPECT_EQ(json[2]["name"], "osmesa");
  for (const auto& backend : json) {
    EXPECT_TRUE(backend["works"].is_boolean());
    EXPECT_FALSE(backend["detail"].get<std::string>().empty());
  }
}

}  // namespace glint::test::render_cli_test
