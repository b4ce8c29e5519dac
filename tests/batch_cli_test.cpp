// Many models in one run: lists, files left after an interruption, shards, reports.

#include <gmock/gmock.h>

#include <set>

#include "glint/image/read_image.h"
#include "gltf_text.h"
#include "running.h"
#include "scenes.h"

namespace glint::test::batch_cli_test {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string sphere = shipped + "sphere.glb", torus = shipped + "torus.glb";

/// A cube that is quick to draw; with a material so that two can differ.
std::string cube(const std::string& name, const Folder& folder) {
  return glint::test::writeGltf(name, glint::test::sphere(4, 2), nullptr, folder.path());
}

std::string listOf(const Folder& folder, const std::vector<std::string>& lines) {
  std::ofstream list(folder / "list");
  for (const std::string& line : lines) list << line << "\n";
  return folder / "list";
}

Arguments tiny(Arguments arguments, const Arguments& more = {}) {
  arguments.insert(arguments.end(), {"--resolution", "32,32"});
  return quick(std::move(arguments), more);
}

/// Draws the models of a list, "-" from stdin, to pictures of `output`.
Arguments tinyList(const std::string& list, const std::string& output, const Arguments& more = {}) {
  return tiny({"render", "--from-list", list, "-o", output}, more);
}

std::vector<int> statusesIn(const std::vector<Json>& pictures) {
  std::vector<int> statuses;
  for (const Json& each : pictures) statuses.push_back(each["status"]);
  return statuses;
}

/// Which of the pictures were there already.
std::vector<bool> skippedIn(const std::vector<Json>& pictures) {
  std::vector<bool> skipped;
  for (const Json& each : pictures) skipped.push_back(each.contains("skipped"));
  return skipped;
}

// A model from a pipe gives the same picture as its file, and errors name it as stdin.
TEST(Stdin, IsAModel) {
  Folder folder("stdin");
  ASSERT_EQ(runGlint(tiny({"render", sphere, "-o", folder / "file.png"})).status, 0);
  for (const std::string name : {"-", "/dev/stdin"}) {
    EXPECT_EQ(piped(contents(sphere), tiny({"render", name, "-o", folder / "{model}.png"})).status,
              0);
    EXPECT_EQ(readImage(folder / "stdin.png").values, readImage(folder / "file.png").values);
    std::filesystem::remove(folder / "stdin.png");
  }
  const Ran info = piped(contents(sphere), {"info", "-"});
  EXPECT_THAT(info.out, testing::StartsWith("stdin: "));
  EXPECT_EQ(info.status, 0);
  for (const Arguments& command : {tiny({"render", "-", "-o", folder / "none.png"}), {"info", "-"}})
    expectRefusal(runGlint(command), "stdin: is empty: give a .gltf or .glb file");
  const Ran list = runGlint(tinyList(listOf(folder, {sphere}), folder / "{folder}.png"));
  EXPECT_EQ(list.status, 0) << list.err;
  EXPECT_THAT(folder.names(), ElementsAre("file.png", "list", "models.png"));
}

TEST(Stdin, IsConvertedAndStudied) {
  Folder folder("stdin-others");
  const auto convert = [&](const std::string& in, const std::string& out) {
    return Arguments{"convert", in, folder / out, "--material", "exponent=77"};
  };
  ASSERT_EQ(runGlint(convert(sphere, "file.glb")).status, 0);
  EXPECT_EQ(piped(contents(sphere), convert("-", "piped.glb")).status, 0);
  EXPECT_EQ(contents(folder / "piped.glb"), contents(folder / "file.glb"));
  expectRefusal(runGlint(convert("-", "none.glb")), "stdin: is empty");
  EXPECT_EQ(piped(contents(sphere), convert("-", "none.gltf")).status, 2);  // a GLB stays one
  EXPECT_EQ(piped(contents(sphere),
                  joined(split("study - --quick --repetitions 2 --resolution 16,16 --shading phong "
                               "--highlight exact --rendering-backend osmesa --json"),
                         {folder / "study.json"}))
                .status,
            0);
  EXPECT_THAT(contents(folder / "study.json"), HasSubstr("\"stdin\""));
  EXPECT_THAT(folder.names(), ElementsAre("file.glb", "piped.glb", "study.json"));
}

TEST(Stdin, IsNotTheListAndAModelOfIt) {
  Folder folder("stdin-list");
  const Ran ran = piped("-\n" + sphere + "\n", tinyList("-", folder / "{n}.png"));
  EXPECT_THAT(statusesIn(jsonLines(ran.out)), ElementsAre(2, 0));
  EXPECT_EQ(ran.status, 2);
}

TEST(List, EachLineIsAPictureAndALineOfJson) {
  Folder folder("list");
  const std::string list = listOf(
      folder, {"\xEF\xBB\xBF" + sphere, "", torus + "\t" + (folder / "own.png"), sphere + "\r"});
  const Ran ran = runGlint(tinyList(list, folder / "{n}-{model}.png"));
  expectDone(ran);
  EXPECT_THAT(folder.names(), ElementsAre("0-sphere.png", "2-sphere.png", "list", "own.png"));
  const auto lines = jsonLines(ran.out);
  ASSERT_EQ(lines.size(), 3u);
  const std::string outputs[] = {"0-sphere.png", "own.png", "2-sphere.png"};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(lines[i]["model"], i == 1 ? torus : sphere);
    EXPECT_EQ(lines[i]["output"], folder / outputs[i]);
    EXPECT_EQ(lines[i]["status"], 0);
    for (const char* key : {"triangles", "draws", "samples", "variants", "ms", "warnings"})
      EXPECT_TRUE(lines[i].contains(key)) << key;
  }
  // As when drawn separately.
  EXPECT_EQ(runGlint(tiny({"render", torus, "-o", folder / "alone.png"})).status, 0);
  EXPECT_EQ(contents(folder / "alone.png"), contents(folder / "own.png"));
}

TEST(List, AReportHasAllThatWasDrawn) {
  Folder folder("list_report");
  const std::string list = listOf(folder, {sphere, folder / "none.glb", torus});
  const auto linesWith = [&](const std::string& report) {
    const Ran ran = runGlint(tinyList(list, folder / "{n}.png", {"--json", report}));
    EXPECT_EQ(ran.status, 2);
    return jsonLines(ran.out).size();
  };
  EXPECT_EQ(linesWith(folder / "report.json"), 3u);
  const Json report = Json::parse(contents(folder / "report.json"));
  EXPECT_EQ(report["backend"], "osmesa");
  EXPECT_TRUE(report["gl"]["renderer"].is_string());
  ASSERT_EQ(report["pictures"].size(), 3u);
  EXPECT_EQ(report["pictures"][1]["status"], 2);
  EXPECT_EQ(linesWith("-"), 3u);  // the default for stdout
}

TEST(List, AFailedModelDoesNotStopTheRest) {
  Folder folder("list_failed");
  std::ofstream(folder / "broken.glb") << "glTF but not really";
  const std::vector<std::string> models{sphere, folder / "broken.glb", folder / "none.glb",
                                        folder.path(), torus};
  const std::string list = listOf(folder, models);
  for (const bool fromList : {true, false}) {
    const Ran ran = runGlint(fromList ? tinyList(list, folder / "{n}.png")
                                      : tiny({"render", "-o", folder / "{n}.png"}, models));
    EXPECT_EQ(ran.status, 2);
    EXPECT_EQ(ran.errorLines().size(), 3u) << ran.err;
    EXPECT_THAT(folder.names(), ElementsAre("0.png", "4.png", "broken.glb", "list"));
    if (fromList) {
      EXPECT_THAT(statusesIn(jsonLines(ran.out)), ElementsAre(0, 2, 2, 2, 0));
    }
  }
}

// The first picture is reported before the second line is written.
TEST(List, FromAPipeEachPictureIsMadeAsSoonAsItsLineIsThere) {
  Folder folder("stream");
  Running run(tinyList("-", folder / "{n}.png"));
  for (const char* name : {"000000.png", "000001.png", "000002.png"}) {
    run.write(sphere + "\n");
    const std::string line = run.line();
    ASSERT_FALSE(line.empty());
    EXPECT_EQ(Json::parse(line)["output"], folder / name);
    EXPECT_EQ(readImage(folder / name).width, 32);
  }
  run.write(torus);  // without an end of line
  run.closeIn();
  EXPECT_EQ(Json::parse(run.line())["model"], torus);
  EXPECT_EQ(run.line(), "");
  EXPECT_EQ(run.wait(), 0);
}

TEST(List, TwoPicturesWithOneNameAreRefusedBeforeAnythingIsDrawn) {
  Folder folder("list_names");
  const std::string list = listOf(folder, {sphere, torus, sphere});
  const Ran ran = runGlint(tinyList(list, folder / "{model}.png"));
  EXPECT_EQ(ran.status, 2);
  EXPECT_THAT(ran.err, AllOf(HasSubstr("model 0"), HasSubstr("sphere.png"), HasSubstr("{n}")));
  EXPECT_THAT(ran.out, IsEmpty());
  EXPECT_THAT(folder.names(), ElementsAre("list"));
  // A pipe cannot be scanned beforehand: only the second one fails.
  const Ran stream =
      piped(sphere + "\n" + sphere + "\n" + torus + "\n", tinyList("-", folder / "{model}.png"));
  EXPECT_THAT(statusesIn(jsonLines(stream.out)), ElementsAre(0, 2, 0));
  EXPECT_EQ(stream.status, 2);
}

TEST(List, AnEmptyOneIsNoErrorButSaysSo) {
  Folder folder("list_empty");
  const Ran ran = runGlint(tinyList(listOf(folder, {""}), folder / "a.png"));
  EXPECT_EQ(ran.status, 0);
  EXPECT_THAT(ran.errorLines(), ElementsAre(HasSubstr("no models")));
}

TEST(Shard, PartsAreDisjointAndTogetherAll) {
  Folder folder("shards");
  const std::vector<std::string> models(11, cube("cube", folder));
  const std::string list = listOf(folder, models);
  std::multiset<std::string> drawn;
  for (const std::string shard : {"1/4", "2/4", "3/4", "4/4"}) {
    const Ran ran = runGlint(tinyList(list, folder / "{n}.png", {"--shard", shard}));
    EXPECT_EQ(ran.status, 0) << ran.err;
    const auto lines = jsonLines(ran.out);
    EXPECT_EQ(lines.size(), shard == "4/4" ? 2u : 3u);
    for (const Json& line : lines) drawn.insert(line["output"]);
  }
  EXPECT_EQ(drawn.size(), 11u);
  EXPECT_EQ(std::set<std::string>(drawn.begin(), drawn.end()).size(), 11u);
  EXPECT_EQ(drawn.count(folder / "10.png"), 1u);
  // For a single model, the pictures are divided.
  std::size_t frames = 0;
  for (const char* shard : {"1/2", "2/2"})
    frames +=
        reportOf(runGlint(tiny({"render", models[0], "-o", folder / "t{frame}.png", "--turntable",
                                "5", "--shard", shard, "--json", "-"})))["pictures"]
            .size();
  EXPECT_EQ(frames, 5u);
}

TEST(Resume, SkipsWhatIsDoneWithTheSameModelAndLook) {
  Folder folder("resume");
  const std::string a = cube("a", folder), b = cube("b", folder);
  const std::string list = listOf(folder, {a, b});
  const auto skipped = [&](const std::string& options) {
    const Ran ran = runGlint(tinyList(list, folder / "{model}.png", split("--resume " + options)));
    EXPECT_EQ(ran.status, 0) << ran.err;
    return skippedIn(jsonLines(ran.out));
  };
  EXPECT_THAT(skipped(""), ElementsAre(false, false));
  const std::string bytes = contents(folder / "a.png");
  EXPECT_THAT(skipped(""), ElementsAre(true, true));
  EXPECT_EQ(contents(folder / "a.png"), bytes);
  // Another look or another depth: everything is made again.
  EXPECT_THAT(skipped("--exposure 1"), ElementsAre(false, false));
  EXPECT_THAT(skipped("--exposure 1"), ElementsAre(true, true));
  EXPECT_THAT(skipped("--bit-depth 16"), ElementsAre(false, false));
  EXPECT_THAT(skipped(""), ElementsAre(false, false));
  // A model, or a file that it refers to, has changed.
  {
    std::fstream bin(folder / "a.bin", std::ios::in | std::ios::out | std::ios::binary);
    bin.seekp(3);
    bin.put('\x3e');
  }
  EXPECT_THAT(skipped(""), ElementsAre(false, true));
  std::ofstream(b, std::ios::app) << "\n";
  EXPECT_THAT(skipped(""), ElementsAre(true, false));
  // A picture that is damaged, or not ours.
  std::ofstream(folder / "b.png") << bytes.substr(0, 60);
  EXPECT_THAT(skipped(""), ElementsAre(true, false));
  std::filesystem::remove(folder / "a.png");
  EXPECT_THAT(skipped(""), ElementsAre(false, true));
}

TEST(Resume, OfATurntableAndOfExr) {
  Folder folder("resume_turntable");
  const auto skipped = [&](const std::string& frames) {
    return skippedIn(
        reportOf(runGlint(tiny({"render", sphere, "-o", folder / "{frame}.exr", "--turntable",
                                frames, "--resume", "--json", "-"})))["pictures"]);
  };
  EXPECT_THAT(skipped("3"), ElementsAre(false, false, false));
  std::filesystem::remove(folder / "1.exr");
  EXPECT_THAT(skipped("3"), ElementsAre(true, false, true));
  EXPECT_THAT(skipped("4"), ElementsAre(false, false, false, false));
}

// Interrupted in the middle, then resumed: pictures reported as done are not made again, and in the
// end all are there. A pipe holds fewer unread lines (64 KiB) than are left.
TEST(Resume, ABatchKilledInTheMiddleLosesAndRepeatsNothing) {
  constexpr std::size_t all = 300, before = 100;
  for (const int number : {SIGKILL, SIGINT, SIGTERM}) {
    Folder folder("killed");
    std::filesystem::create_directories(folder / "out");
    const std::string list = listOf(folder, std::vector<std::string>(all, cube("cube", folder)));
    const Arguments command = tinyList(list, folder / "out/{n}.png", {"--resume"});
    std::set<std::string> told;
    {
      Running run(command);
      while (told.size() < before) told.insert(Json::parse(run.line())["output"]);
      run.signal(number);
      for (std::string line = run.line(); !line.empty(); line = run.line())
        told.insert(Json::parse(line)["output"]);
      EXPECT_EQ(run.wait(), number == SIGKILL ? -SIGKILL : 128 + number);
    }
    EXPECT_GE(told.size(), before);
    EXPECT_LT(told.size(), all);
    const auto filesThere = [&] {
      std::set<std::string> files;
      for (const auto& file : std::filesystem::directory_iterator(folder / "out"))
        files.insert(file.path().string());
      return files;
    };
    // Every file is complete; unreported files are at most those that were in progress.
    const std::set<std::string> there = filesThere();
    for (const std::string& file : there) EXPECT_EQ(readImage(file).width, 32);
    EXPECT_TRUE(std::includes(there.begin(), there.end(), told.begin(), told.end()));
    EXPECT_LE(there.size(), told.size() + (number == SIGKILL ? 1 : 0));

    const Ran rest = runGlint(command);
    EXPECT_EQ(rest.status, 0) << rest.err;
    std::set<std::string> skipped, drawn;
    for (const Json& line : jsonLines(rest.out))
      (line.contains("skipped") ? skipped : drawn).insert(line["output"]);
    EXPECT_EQ(skipped, there);
    EXPECT_EQ(drawn.size(), all - there.size());
    EXPECT_EQ(filesThere().size(), all);
  }
}

TEST(Interrupt, EndsARunThatWaitsForItsList) {
  Folder folder("waiting");
  Running run(tinyList("-", folder / "{n}.png"));
  run.write(sphere + "\n");
  EXPECT_FALSE(run.line().empty());
  run.signal(SIGINT);
  EXPECT_EQ(run.wait(), 130);
  EXPECT_THAT(folder.names(), ElementsAre("000000.png"));
}

TEST(Batch, ReferencesAreComparedAtOnce) {
  Folder folder("references");
  std::filesystem::create_directories(folder / "baseline");
  const auto run = [&](const std::string& options) {
    const int status =
        runGlint(tiny({"render", sphere, torus, "-o", folder / "{model}.png", "--reference",
                       folder / "baseline/{model}.png", "--json", folder / "report.json"},
                      split(options)))
            .status;
    std::vector<int> each = statusesIn(Json::parse(contents(folder / "report.json"))["pictures"]);
    EXPECT_EQ(each.size(), 2u);
    each.insert(each.begin(), status);
    return each;
  };
  EXPECT_THAT(run(""), ElementsAre(4, 4, 4));
  std::filesystem::copy_file(folder / "sphere.png", folder / "baseline/sphere.png");
  EXPECT_THAT(run(""), ElementsAre(4, 0, 4));
  std::filesystem::copy_file(folder / "torus.png", folder / "baseline/torus.png");
  EXPECT_THAT(run(""), ElementsAre(0, 0, 0));
  EXPECT_THAT(run("--exposure -0.1"), ElementsAre(1, 1, 1));
  // A picture that is there already is not drawn anew, but compared all the same.
  EXPECT_THAT(run("--exposure -0.1 --resume"), ElementsAre(1, 1, 1));
  EXPECT_THAT(run("--resume"), ElementsAre(0, 0, 0));
  EXPECT_THAT(run("--resume"), ElementsAre(0, 0, 0));
  EXPECT_THAT(run("--exposure -0.1 --reference-threshold 0.5"), ElementsAre(0, 0, 0));
  EXPECT_THAT(run("--exposure -0.1 --reference-threshold 0.0001"), ElementsAre(1, 1, 1));
  std::ofstream(folder / "baseline/torus.png") << "no picture";
  EXPECT_THAT(run(""), ElementsAre(2, 0, 2));
  EXPECT_THAT(run("--resume"), ElementsAre(2, 0, 2));
  EXPECT_THAT(run("--exposure -0.1"), ElementsAre(2, 1, 2));
}

TEST(Batch, OptionsThatExcludeEachOther) {
  Folder folder("exclude");
  const std::string list = listOf(folder, {sphere});
  const Arguments one{sphere, "-o", folder / "{n}.png"};
  const auto refused = [](const Arguments& options, const std::string& part) {
    SCOPED_TRACE(testing::PrintToString(options));
    expectRefusal(runGlint(tiny({"render"}, options)), part);
  };
  refused({"-o", folder / "{n}.png"}, "MODEL");
  refused({"--from-list", list, "-o", "-"}, "-o -");
  refused({"--from-list", folder / "none", "-o", folder / "{n}.png"}, "none");
  refused({"--from-list", folder.path(), "-o", folder / "{n}.png"}, "directory");
  refused({sphere, "-o", folder / "a.pfm", "--resume"}, ".pfm");
  refused({sphere, "-o", folder / "{frame}.png", "--frames", "2", "--turntable", "3"},
          "same number");
  refused({sphere, "-o", folder / "{frame}.png"}, "--turntable");
  refused({sphere, "-o", "-", "--reference", "a.png"}, "--reference");
  refused({sphere, "-o", "-", "--terms"}, "--terms");
  refused({sphere, torus, "-o", "-"}, "would both become");
  const std::pair<std::string, std::string> ofOne[] = {
      {"--from-list " + list, "--from-list"},
      {"--shard 0/2", "--shard"},
      {"--shard 3/2", "--shard"},
      {"--shard 1", "--shard"},
      {"--shard 1/2x", "--shard"},
      {"--jobs 0", "--jobs"},
      {"--turntable 0", "--turntable"},
      {"--turntable 2", "{frame}"},
      {"--frames 2", "{frame}"},
      {"--reference-threshold 1", "--reference"},
      {"--terms --sweep ior=1:2:3", "--sweep"},
      {"--sweep ior=1:2:3 --sweep ior=1:2:3 --sweep ior=1:2:3", "--sweep"}};
  for (const auto& [options, part] : ofOne) refused(joined(one, split(options)), part);
  EXPECT_THAT(folder.names(), ElementsAre("list"));
}

}  // namespace glint::test::batch_cli_test
