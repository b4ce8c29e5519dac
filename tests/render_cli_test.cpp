// Pictures and reports of the binary.

#include <gmock/gmock.h>

#include "command.h"
#include "glint/image/read_image.h"
#include "glint/image/srgb.h"
#include "glint/image/stored_image.h"
#include "gltf_text.h"
#include "scenes.h"

namespace glint::test::render_cli_test {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

const std::string sphere = shipped + "sphere.glb", torus = shipped + "torus.glb";

// Draws the sphere with these options; returns the bytes of the picture.
std::string picture(const Folder& folder, const std::string& options = "",
                    const std::string& name = "a.pfm") {
  expectDone(runGlint(quick({"render", sphere, "-o", folder / name}, split(options))));
  return contents(folder / name);
}

/// Draws a model at its full number of samples.
void draw(const std::string& model, const std::string& output, const std::string& options) {
  expectDone(runGlint(
      joined({"render", model, "-o", output, "--rendering-backend", "osmesa"}, split(options))));
}

TEST(Render, WritesPngAndPfmOfTheSamePicture) {
  Folder folder("formats");
  picture(folder, "", "a.png");
  picture(folder, "--bit-depth 16", "deep.png");
  picture(folder, "", "a.pfm");
  picture(folder, "", "UPPER.PNG");
  EXPECT_EQ(contents(folder / "a.png"), contents(folder / "UPPER.PNG"));
  const Image linear = readImage(folder / "a.pfm"), png = readImage(folder / "a.png"),
              deep = readImage(folder / "deep.png");
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
  const std::string file = picture(folder, "", "a.png");
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
  const std::string spaced = picture(folder,
                                     "--camera-position -1,2,3 --camera-azimuth-angle -10 "
                                     "--light directional:-1,-1,1 --camera-focal-point -.1,0,0");
  const std::string withEquals =
      picture(folder,
              "--camera-position=-1,2,3 --camera-azimuth-angle=-10 "
              "--light=directional:-1,-1,1 --camera-focal-point=-.1,0,0");
  EXPECT_EQ(spaced, withEquals);
  EXPECT_NE(spaced, picture(folder, "--camera-position 1,2,3"));
}

// PFM is before exposure; PNG is multiplied by 2^EV before the encode.
TEST(Render, ExposureScalesByPowersOfTwo) {
  Folder folder("exposure");
  const std::string plain = picture(folder);
  EXPECT_EQ(plain, picture(folder, "--exposure -1"));
  const Image linear = readImage(folder / "a.pfm");
  for (const auto& [ev, scale] : {std::pair("-1", 0.5f), {"2", 4.0f}}) {
    picture(folder, std::string("--exposure ") + ev, "a.png");
    const Image png = readImage(folder / "a.png");
    for (std::size_t i = 0; i < linear.values.size(); ++i)
      if (i % 4 != 3) {
        ASSERT_EQ(png.values[i], glint::decodeSrgb8(glint::encodeSrgb8(scale * linear.values[i])));
      }
  }
}

// A step of 8-bit codes is 1 / (255 * 12.92) wide at black, after exposure, and wider elsewhere.
TEST(Render, ErrorsInCodesAreThoseOfThePicture) {
  Folder folder("codes");
  const auto chosen = [](const std::string& options) {
    return reportOf(runGlint(joined({"info", torus, "--json", "-"}, split(options))))["choice"];
  };
  const double step = 1 / (255 * 12.92);
  EXPECT_NEAR(chosen("--max-error 1code")["max-error"].get<double>(), step, 1e-12);
  EXPECT_NEAR(chosen("--max-error 2.5code --exposure 3")["max-error"].get<double>(), 2.5 * step / 8,
              1e-12);
  const Json choice = chosen("--max-error 40code --highlight exact");
  EXPECT_NE(choice["materials"][0]["highlight"], "exact");
  EXPECT_LE(choice["bound"].get<double>(), 40 * step);

  for (const std::string exposure : {"--exposure 0", "--exposure 2"}) {
    picture(folder, exposure, "exact.png");
    picture(folder, exposure + " --max-error 3code", "a.png");
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
  const auto corner = [&](const std::string& options) {
    picture(folder, options, "a.png");
    const Image image = readImage(folder / "a.png");
    return std::vector<float>(image.values.begin(), image.values.begin() + 4);
  };
  const float grey = glint::decodeSrgb8(0x33);
  EXPECT_THAT(corner(""), ElementsAre(grey, grey, grey, 1));
  EXPECT_THAT(corner("--background-color #ff8000"), ElementsAre(1, glint::decodeSrgb8(0x80), 0, 1));
  EXPECT_THAT(corner("--no-background"), ElementsAre(0, 0, 0, 0));
  // PFM has no alpha: the background is black.
  picture(folder, "--no-background");
  EXPECT_EQ(readImage(folder / "a.pfm").values[0], 0);
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
  const std::string drawn = picture(
      folder,
      "--shading blinn-phong --material exponent=60,color=0.2,0.4,0.8,specular=0.7 "
      "--light point:2,3,4:1,0.9,0.8 --light camera:0.3,0.3,0.3 --camera-azimuth-angle 12.3456789 "
      "--camera-view-angle 41 --background-color #204060 --exposure 0.25 "
      "--ambient-light 0.1,0.2,0.30000000000000004 --resolution 33,44 --two-sided "
      "--viewer infinite --save-look " +
          folder / "look.json",
      "a.png");
  draw(sphere, folder / "b.png", "--look " + folder / "look.json");
  EXPECT_EQ(drawn, contents(folder / "b.png"));
  // The look saved from it is the same file.
  draw(sphere, folder / "b.png",
       "--look " + folder / "look.json" + " --save-look " + folder / "again.json");
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
    draw(torus, first,
         "--resolution 33,21 --shading environment --material ior=1.7,color=0.2,0.4,0.8 "
         "--light point:2,3,4:1,0.9,0.8 --camera-azimuth-angle 12.3456789 --exposure 0.1 "
         "--no-background");
    draw(torus, again, "--look " + first);
    EXPECT_EQ(contents(first), contents(again));
    const auto text = glint::readPictureText(first);
    EXPECT_THAT(text.at("GL_RENDERER"), HasSubstr("llvmpipe"));
    EXPECT_THAT(text.at("Software"), StartsWith("glint "));
    // As with a look file, options take precedence over it.
    draw(torus, again, "--look " + first + " --exposure 1");
    EXPECT_NE(contents(first), contents(again));
  }
  const std::string foreign = GLINT_SOURCE_DIR "/docs/programs.png";
  expectRefusal(runGlint({"render", torus, "-o", folder / "c.png", "--look", foreign}),
                "a picture without a stored look");
}

TEST(Render, ExrHoldsTheLinearValues) {
  Folder folder("exr");
  picture(folder, "--exposure 2");
  picture(folder, "--exposure 2", "a.exr");
  const Image pfm = readImage(folder / "a.pfm"), exr = readImage(folder / "a.exr");
  EXPECT_EQ(pfm.values, exr.values);
  // With alpha: the sphere is opaque, its surroundings are transparent.
  picture(folder, "--no-background", "a.exr");
  const Image alpha = readImage(folder / "a.exr");
  EXPECT_EQ(alpha.values[3], 0);
  EXPECT_EQ(alpha.row(15)[4 * 20 + 3], 1);
}

// Straight alpha: where a surface covers part of a pixel, its colour is the surface's own and alpha
// is the coverage. A square of one colour has that colour wherever its coverage is above 0.
TEST(Render, TransparentBackgroundHasStraightColoursAtTheEdges) {
  Folder folder("straight");
  const std::string model = glint::test::writeGltf(
      "square", glint::test::quad(),
      [](Json& json) {
        json["extensionsUsed"] = {"KHR_materials_unlit"};
        json["materials"][0] = {
            {"name", "paint"},
            {"extensions", {{"KHR_materials_unlit", Json::object()}}},
            {"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 0.25, 0.125, 1}}}}};
      },
      folder.path());
  for (const std::string antiAliasing : {"msaa:4", "ssaa:4"})
    for (const auto& [depth, codes] : {std::pair("8", 255.0f), {"16", 65535.0f}}) {
      draw(model, folder / "a.png",
           "--no-background --resolution 40,40 --camera-zoom-factor 0.7 --anti-aliasing " +
               antiAliasing + " --bit-depth " + depth);
      const glint::StoredImage stored = glint::readStoredImage(folder / "a.png");
      std::vector<float> rgba(4 * 1600);
      stored.encodedRows(0, 40, rgba.data());
      std::map<float, int> alphas;
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

TEST(Render, CommandLineBeatsLookBeatsModelBeatsDefault) {
  Folder folder("precedence");
  std::ofstream(folder / "look.json")
      << R"({"glint-look": 1, "shading": "flat", "exposure": 3, "light": ["directional:0,0,1"],
             "no-lights": true, "resolution": [40, 30], "anti-aliasing": "none",
             "material": {"": {"exponent": 5, "specular": 0.25}}})";
  const auto saved = [&](const std::string& options) {
    const Ran ran = runGlint(joined(
        {"info", sphere, "--look", folder / "look.json", "--save-look", folder / "saved.json"},
        split(options)));
    EXPECT_EQ(ran.status, 0) << ran.err;
    return Json::parse(contents(folder / "saved.json"));
  };
  Json look = saved("");
  EXPECT_EQ(look["shading"], "flat");
  EXPECT_EQ(look["exposure"], 3.0);
  EXPECT_EQ(look["light"].size(), 1u);
  look = saved("--shading gouraud --exposure -1");
  EXPECT_EQ(look["shading"], "gouraud");
  EXPECT_EQ(look["exposure"], -1.0);
  // Given lights replace the file's, even if the file has none.
  look = saved("--light camera --light point:1,2,3");
  EXPECT_EQ(look["light"].size(), 2u);
  EXPECT_EQ(look["no-lights"], false);
  // Flags can be reset.
  look = saved("--no-lights=false");
  EXPECT_EQ(look["no-lights"], false);
  // An edit of all materials takes precedence over the file's edit of one.
  look = saved("--material exponent=7");
  EXPECT_EQ(look["material"][""]["exponent"], 7.0);
  EXPECT_EQ(look["material"][""]["specular"], 0.25);

  // The model's own parameters, unless the look has them; the file's edits of one material, unless
  // the command line edits all.
  const auto shown = [&](const Arguments& options) {
    return reportOf(runGlint(joined({"info", sphere, "--json", "-"}, options)))["materials"][0];
  };
  const Json own = shown({});
  EXPECT_NE(own["exponent"], 20.0);  // the default of a material without parameters
  EXPECT_EQ(shown({"--look", folder / "look.json"})["exponent"], 5.0);
  const std::string name = own["name"];
  ASSERT_FALSE(name.empty());
  std::ofstream(folder / "named.json")
      << Json{{"glint-look", 1}, {"material", {{name, {{"exponent", 5}, {"ior", 2}}}}}};
  EXPECT_EQ(shown({"--look", folder / "named.json"})["exponent"], 5.0);
  const Json edited = shown({"--look", folder / "named.json", "--material", "exponent=9"});
  EXPECT_EQ(edited["exponent"], 9.0);
  EXPECT_EQ(edited["ior"], 2.0);
}

TEST(Render, LastOfARepeatedOptionCounts) {
  Folder folder("repeated");
  EXPECT_EQ(picture(folder, "--shading flat --shading gouraud"),
            picture(folder, "--shading gouraud"));
}

TEST(Render, ReportsInJson) {
  Folder folder("json");
  const Ran ran =
      runGlint(quick({"render", sphere, torus, "-o", folder / "{model}.png", "--json", "-"}));
  expectDone(ran);
  const auto report = Json::parse(ran.out);
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
  for (const auto& [antiAliasing, count] : samples)
    EXPECT_EQ(reportOf(runGlint({"render", sphere, "-o", folder / "s.png", "--json", "-",
                                 "--resolution", "8,8", "--rendering-backend", "osmesa",
                                 "--anti-aliasing", antiAliasing}))["pictures"][0]["samples"],
              count)
        << antiAliasing;
}

TEST(Render, BothBackendsGiveTheSameFiles) {
  Folder folder("backends");
  for (const char* antiAliasing : {"msaa:4", "none"})
    for (const std::string ending : {".png", ".pfm"}) {
      for (const std::string backend : {"osmesa", "egl-software"})
        expectDone(runGlint({"render", torus, "-o", folder / (backend + ending), "--resolution",
                             "60,50", "--anti-aliasing", antiAliasing, "--shading", "environment",
                             "--rendering-backend", backend}));
      EXPECT_EQ(contents(folder / ("osmesa" + ending)),
                contents(folder / ("egl-software" + ending)));
    }
}

TEST(Render, TakesShadersFromAFolder) {
  Folder folder("glsl_override");
  std::ofstream(folder / "phong.glsl") << "#if !VERTEX_STAGE\nvec3 shade(vec4 base) {\n"
                                          "  return vec3(0.0, 1.0, 0.0);\n}\n#endif\n";
  picture(folder, "--glsl " + folder.path());
  const Image image = readImage(folder / "a.pfm");
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
  const Image image = readImage(folder / "a.png");
  for (std::size_t i = 0; i < image.values.size(); i += 4)
    ASSERT_EQ(image.values[i], glint::decodeSrgb8(0x33));
}

TEST(Render, NeedsNoHome) {
  Folder folder("home");
  const glint::test::CommandOptions nobody{
      .environment = {{"HOME", ""}, {"USER", ""}, {"XDG_CACHE_HOME", ""}, {"XDG_RUNTIME_DIR", ""}}};
  for (const char* backend : {"osmesa", "egl-software"})
    expectDone(runGlint({"render", sphere, "-o", folder / "a.png", "--resolution", "16,16",
                         "--rendering-backend", backend},
                        nobody));
}

TEST(Render, WritesWhereItStands) {
  Folder folder("relative");
  expectDone(runGlint(quick({"render", sphere, "-o", "a.png"}), {.folder = folder.path()}));
  EXPECT_THAT(folder.names(), ElementsAre("a.png"));
}

}  // namespace glint::test::render_cli_test
