// How glint refuses input: the status, one line on stderr that says what, where and what to do, and
// no files left behind.

#include <gmock/gmock.h>
#include <sys/stat.h>

#include "command.h"
#include "scenes.h"

namespace glint::test::errors_cli_test {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

const std::string sphere = shipped + "sphere.glb";

Ran render(const std::string& out, const std::string& options = "") {
  return runGlint(joined({"render", sphere, "-o", out}, split(options)));
}

/// A small picture, whose options say nothing wrong.
Ran draw(const std::string& out, const std::string& options = "") {
  return runGlint(quick({"render", sphere, "-o", out}, split(options)));
}

TEST(Usage, CommandsAndOptionsThatDoNotExist) {
  expectRefusal(runGlint({}), "see glint --help");
  expectRefusal(runGlint({"rendre", "a.glb"}), "did you mean 'render'?");
  expectRefusal(runGlint({"frobnicate"}), "see glint --help");
  expectRefusal(runGlint({"--frobnicate"}), "--help");
  Folder folder("unknown");
  const std::pair<const char*, const char*> options[] = {
      {"--shadin", "'--shading'"},
      {"--resolutoin", "'--resolution'"},
      {"--camera-positon", "'--camera-position'"},
      {"--antialiasing", "'--anti-aliasing'"},
      {"--save-lok", "'--save-look'"},
      {"--outpt", "'--output'"}};
  for (const auto& [wrong, right] : options) {
    const std::string expected =
        "unknown option '" + std::string(wrong) + "': did you mean " + right;
    for (const char* value : {" 1", "=1"})
      expectRefusal(render(folder / "a.png", wrong + std::string(value)), expected);
  }
  expectRefusal(render(folder / "a.png", "--qqqqqqqqq"), "see glint render --help");
  expectRefusal(runGlint({"backends", "extra"}), "unexpected 'extra'");
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(Usage, MissingModelAndOutput) {
  Folder folder("missing");
  expectRefusal(runGlint({"render", "-o", folder / "a.png"}), "MODEL");
  expectRefusal(runGlint({"render", sphere}), "--output");
  expectRefusal(runGlint({"info"}), "MODEL");
  expectRefusal(runGlint({"render", sphere, "-o"}), "-o");
  expectRefusal(render(folder / "a.png", "--shading"), "--shading");
  EXPECT_THAT(folder.names(), IsEmpty());
}

// Every option of the table with a bad value: the message names it and says what is expected.
TEST(Usage, BadValuesOfOptions) {
  const std::string options =
      "--shading toon|--highlight lyon:7|--fresnel cubic|--blinn-factor -1|"
      "--schlick-exponent x|--material shine=1|--ambient-light 1,1|--light sun:1,2,3|"
      "--viewer far|--medium-ior 0|--environment black|--environment-rotation x|"
      "--camera-position 1,2|--camera-focal-point a|--camera-view-up 0,0,0|"
      "--camera-view-angle 180|--camera-direction 0,0,0|--camera-azimuth-angle x|"
      "--camera-elevation-angle x|--camera-zoom-factor 0|--camera-index -1|"
      "--clipping-range 2,1|--resolution 0,1|--anti-aliasing msaa|--background-color x|"
      "--exposure 99|--bit-depth 12|--rendering-backend metal|--bit-depth x|"
      "--no-lights=maybe";
  Folder folder("bad_values");
  for (const std::string& option : partsOf(options)) {
    SCOPED_TRACE(option);
    // Two messages name the value instead.
    const std::string name = option == "--bit-depth 12" ? "bits per channel"
                             : option.starts_with("--rendering-backend")
                                 ? "there is no rendering backend"
                                 : option.substr(0, option.find_first_of(" ="));
    expectRefusal(render(folder / "a.png", option), name);
    if (!option.starts_with("--bit-depth") && !option.starts_with("--rendering-backend"))
      expectRefusal(runGlint(joined({"info", sphere}, split(option))), name);
  }
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(Usage, OptionsThatExcludeEachOther) {
  Folder folder("exclude");
  const std::string png = folder / "a.png";
  for (const char* name : {"a.exr", "a.pfm"})
    expectRefusal(render(folder / name, "--bit-depth 16"), "--bit-depth: only for PNG");
  const std::pair<const char*, const char*> cases[] = {
      {"--no-lights --light camera", "--light and --no-lights"},
      {"--camera-intrinsics 9,9,5,5 --camera-view-angle 30",
       "--camera-intrinsics and --camera-view-angle"},
      {"--camera-intrinsics 9,9,5,5 --camera-orthographic",
       "--camera-intrinsics and --camera-orthographic"},
      {"--sweep exponent=1:9:3 --sweep exponent=1:9:2", "--sweep: twice over exponent"},
      {"--rendering-backend metal", "osmesa, reference"}};
  for (const auto& [options, what] : cases) expectRefusal(render(png, options), what);
  expectRefusal(runGlint({"render", "", "-o", png}), "'': does not exist");
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(Usage, ModelsThatCannotBeRead) {
  Folder folder("unreadable");
  std::ofstream(folder / "text.glb") << "hello";
  for (const std::string& model : {folder / "none.glb", folder.path(), folder / "text.glb"})
    expectRefusal(runGlint(quick({"render", model, "-o", folder / "a.png"})), model);
  std::ofstream(folder / "empty.gltf").flush();
  expectRefusal(runGlint({"info", folder / "empty.gltf"}), "empty.gltf");
  // A pipe without a writer must not hang.
  mkfifo((folder / "pipe.glb").c_str(), 0600);
  expectRefusal(runGlint(quick({"render", folder / "pipe.glb", "-o", folder / "a.png"}),
                         {.timeoutSeconds = 20}),
                "pipe.glb");
  EXPECT_THAT(folder.names(), ElementsAre("empty.gltf", "pipe.glb", "text.glb"));
}

TEST(Usage, OutputsThatCannotBeWritten) {
  Folder folder("outputs");
  expectRefusal(draw(folder / "a.bmp"), "a.bmp: BMP cannot be written: use .png");
  expectRefusal(draw("/proc/none/a.png"), "/proc/none");
  expectRefusal(draw("/proc/a.png"), "/proc/a.png");
  std::filesystem::create_directory(folder / "folder.png");
  expectRefusal(draw(folder / "folder.png"), "folder.png");
  expectRefusal(draw(folder / "{name}.png"), "unknown {name}");
  expectRefusal(draw(""), "-o: '' is empty");
  EXPECT_THAT(folder.names(), ElementsAre("folder.png"));
  EXPECT_THAT(std::filesystem::directory_iterator(folder / "folder.png"),
              std::filesystem::directory_iterator());
  if (geteuid() != 0) {  // root may write anywhere
    Folder locked("locked");
    chmod(locked.path().c_str(), 0500);
    expectRefusal(draw(locked / "a.png"), "a.png");
    EXPECT_THAT(locked.names(), IsEmpty());
  }
}

TEST(Usage, AnOlderPictureSurvivesAFailure) {
  Folder folder("older");
  std::ofstream(folder / "a.png") << "older";
  expectRefusal(draw(folder / "a.png", "--camera-index 5"), "--camera-index 5");
  // More samples than the driver has.
  expectRefusal(render(folder / "a.png", "--rendering-backend osmesa --anti-aliasing msaa:8"),
                "--anti-aliasing ssaa:3");
  EXPECT_EQ(glint::test::contents(folder / "a.png"), "older");
  EXPECT_THAT(folder.names(), ElementsAre("a.png"));
}

TEST(Usage, TwoThingsForStdoutAndTwoPicturesOfOneName) {
  expectRefusal(runGlint({"render", sphere, "-o", "-", "--json", "-"}), "--json -");
  Folder folder("same");
  expectRefusal(runGlint({"render", sphere, shipped + "torus.glb", "-o", folder / "a.png"}),
                "{model} or {n}");
  expectRefusal(runGlint({"render", sphere, sphere, "-o", folder / "{model}.png"}), "{n}");
  expectRefusal(runGlint({"render", sphere, shipped + "torus.glb", "-o", "-"}), "both");
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(Usage, OneOutputDoesNotDestroyAnother) {
  Folder folder("outputs_of_one_name");
  const std::string picture = folder / "a.png", list = folder / "list";
  std::ofstream(list) << sphere << "\n";
  expectRefusal(draw("-", "--save-look -"), "--save-look -: -o already goes to stdout");
  expectRefusal(draw(picture, "--json - --save-look -"), "--json already goes to stdout");
  expectRefusal(runGlint(quick({"render", "--from-list", list, "-o", picture, "--save-look", "-"})),
                "--from-list already goes to stdout");
  expectRefusal(draw(picture, "--json " + folder / "./a.png"), "-o already writes to that file");
  expectRefusal(draw(picture, "--save-look " + picture), "-o already writes to that file");
  expectRefusal(runGlint({"info", sphere, "--json", "-", "--save-look", "-"}),
                "--json already goes to");
  expectRefusal(runGlint({"info", list, "--json", list}), "would overwrite an input file");
  expectRefusal(runGlint({"study", "--json", "-", "--markdown", "-"}),
                "--json already goes to stdout");
  EXPECT_THAT(folder.names(), ElementsAre("list"));
  EXPECT_EQ(draw(picture, "--json /dev/null --save-look /dev/null").status, 0);
}

TEST(Usage, APictureIsNotItsOwnReference) {
  Folder folder("own_reference");
  const std::string picture = folder / "a.png";
  std::ofstream(picture) << "right once";
  for (const std::string& reference : {picture, folder / "../own_reference/{model}.png"}) {
    const std::string output = reference == picture ? picture : folder / "{model}.png";
    expectRefusal(draw(output, "--reference " + reference), "compared with itself");
  }
  EXPECT_EQ(glint::test::contents(picture), "right once");
  EXPECT_THAT(folder.names(), ElementsAre("a.png"));
}

TEST(Usage, WhatWasGivenWithLineBreaksIsToldInOneLine) {
  Folder folder("line_breaks");
  const std::string picture = folder / "a.png";
  expectRefusal(runGlint({"render", sphere, "-o", picture, "--shading", "a\nb"}), R"('a\nb')");
  expectRefusal(runGlint(quick({"render", sphere, "-o", picture, "--material", "a\nb:ior=1"})),
                R"('a\nb')");
  expectRefusal(runGlint({"render", sphere, "-o", picture, "--fro\nb"}), R"('--fro\nb')");
  expectRefusal(runGlint({"fro\nb"}), R"('fro\nb')");
}

// A report that could not be written is not a success.
TEST(Usage, AFullDiskBehindStandardOutput) {
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"--help"},
                                                    {"--version"},
                                                    {"info", sphere},
                                                    {"backends"},
                                                    {"stability", "--list"},
                                                    {"info", sphere, "--json", "-"}}) {
    SCOPED_TRACE(testing::PrintToString(arguments));
    expectRefusal(runGlint(arguments, {.fullOut = true}), "standard output: ");
  }
}

TEST(Usage, ReportsOfFilesWhoseNamesAreNotUtf8) {
  Folder folder("not_utf8");
  const std::string model = folder / "a\xff.glb";
  std::filesystem::copy_file(sphere, model);
  const Ran ran = runGlint({"info", model, "--json", "-"});
  EXPECT_EQ(ran.status, 0) << ran.err;
  EXPECT_TRUE(nlohmann::json::accept(ran.out));
  EXPECT_EQ(draw(folder / "a.png", "--hdri-file \xff --save-look " + folder / "look.json").status,
            0);
  EXPECT_TRUE(nlohmann::json::accept(glint::test::contents(folder / "look.json")));
}

// It measures for a minute, so outputs that cannot be written must be reported first.
TEST(Usage, AStudyRefusesItsFilesAtOnce) {
  for (const char* option : {"--json", "--markdown"})
    expectRefusal(runGlint({"study", option, "/proc/none/a"}, {.timeoutSeconds = 5}), "/proc/none");
}

TEST(Usage, LooksThatCannotBeRead) {
  Folder folder("looks");
  const auto with = [&](const std::string& text) {
    std::ofstream(folder / "look.json") << text;
    return draw(folder / "a.png", "--look " + folder / "look.json");
  };
  expectRefusal(with("{"), "look.json: not a look file");
  expectRefusal(with("{}"), "glint-look");
  expectRefusal(with(R"({"glint-look": 1, "shadin": "flat"})"), "unknown key \"shadin\"");
  expectRefusal(with(R"({"glint-look": 1, "shading": "toon"})"), "\"shading\"");
  expectRefusal(with("{\"glint-look\": 1, \"\n\x1b[31m\": 1}"), "look.json");
  expectRefusal(draw(folder / "a.png", "--look " + folder / "none"), "none");
  expectRefusal(draw(folder / "a.png", "--save-look /proc/none/look.json"), "/proc/none");
  EXPECT_THAT(folder.names(), ElementsAre("look.json"));
}

TEST(Usage, MaterialsAndCamerasThatTheModelLacks) {
  Folder folder("lacks");
  expectRefusal(draw(folder / "a.png", "--material gold:exponent=5"), "no material 'gold'");
  expectRefusal(draw(folder / "a.png", "--camera-index 0"), "--camera-index 0");
  expectRefusal(runGlint({"info", sphere, "--material", "gold:exponent=5"}), "no material 'gold'");
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(Usage, ShaderFoldersThatDoNotServe) {
  Folder folder("glsl");
  expectRefusal(draw(folder / "a.png", "--glsl " + folder / "no"), "--glsl");
  expectRefusal(draw(folder / "a.png", "--glsl " + folder.path()), "none of glint's shader files");
  std::ofstream(folder / "phong.glsl") << "vec3 shade(vec4 base) { return undeclared; }\n";
  const Ran ran = draw(folder / "a.png", "--glsl " + folder.path());
  EXPECT_EQ(ran.status, 2);
  EXPECT_THAT(ran.err, AllOf(HasSubstr("phong"), HasSubstr("undeclared")));
  EXPECT_THAT(folder.names(), ElementsAre("phong.glsl"));
}

// One of three models is broken: the others are drawn, and the status reports it.
TEST(Usage, OneBrokenModelDoesNotStopTheOthers) {
  Folder folder("three");
  std::ofstream(folder / "broken.glb") << "broken";
  const Ran ran = runGlint(quick({"render", shipped + "torus.glb", folder / "broken.glb", sphere,
                                  "-o", folder / "{model}.png", "--json", folder / "report.json"}));
  EXPECT_EQ(ran.status, 2);
  EXPECT_EQ(ran.errorLines().size(), 1u) << ran.err;
  EXPECT_THAT(ran.err, HasSubstr("broken.glb"));
  EXPECT_THAT(folder.names(), ElementsAre("broken.glb", "report.json", "sphere.png", "torus.png"));
  const auto report = nlohmann::json::parse(glint::test::contents(folder / "report.json"));
  ASSERT_EQ(report["pictures"].size(), 3u);
  EXPECT_EQ(report["pictures"][0]["status"], 0);
  EXPECT_EQ(report["pictures"][1]["status"], 2);
  EXPECT_EQ(report["pictures"][2]["status"], 0);
  EXPECT_THAT(report["pictures"][1]["error"].get<std::string>(), HasSubstr("broken.glb"));
}

class FakeDrivers : public testing::TestWithParam<const char*> {};

// No context: status 3, and a line with the reason for each backend. libOSMesa.so.6, an older name,
// may be a real library: then `auto` draws with it and is not tested.
TEST_P(FakeDrivers, GiveReasonsAndStatusThree) {
  const std::string drivers = GLINT_BINARY_DIR "/tests/fake/" + std::string(GetParam());
  const glint::test::CommandOptions options{.environment = {{"LD_LIBRARY_PATH", drivers}}};
  Folder folder("fake");
  for (const char* backend : {"egl", "egl-software", "osmesa"}) {
    const Ran ran = runGlint({"render", sphere, "-o", folder / "a.png", "--resolution", "8,8",
                              "--rendering-backend", backend},
                             options);
    SCOPED_TRACE(backend);
    if (backend == std::string("osmesa") && ran.status == 0) {
      std::filesystem::remove(folder / "a.png");
      continue;  // libOSMesa.so.6 worked
    }
    expectRefusal(ran, "", 3);
  }
  EXPECT_THAT(folder.names(), IsEmpty());

  const Ran list = runGlint({"backends"}, options);
  EXPECT_THAT(list.out, AllOf(HasSubstr("egl "), HasSubstr("egl-software "), HasSubstr("osmesa "),
                              HasSubstr("no ")));
  const Ran automatic =
      runGlint({"render", sphere, "-o", folder / "a.png", "--resolution", "8,8"}, options);
  if (list.status == 0) {
    EXPECT_EQ(automatic.status, 0);
    EXPECT_THAT(automatic.err, HasSubstr("warning")) << "EGL was skipped in silence";
    return;
  }
  EXPECT_EQ(list.status, 3);
  EXPECT_EQ(automatic.status, 3);
  const auto lines = automatic.errorLines();
  ASSERT_EQ(lines.size(), 1u) << automatic.err;
  EXPECT_THAT(lines[0], AllOf(HasSubstr("egl: "), HasSubstr("; osmesa: ")));
  EXPECT_THAT(folder.names(), IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(Cases, FakeDrivers,
                         testing::Values("no-symbols", "no-context", "old-version"),
                         [](const auto& test) {
                           std::string name = test.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace glint::test::errors_cli_test
