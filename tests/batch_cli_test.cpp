// Many pictures in one run: lists, files left after an interruption, shards, reports.

#include <gmock/gmock.h>
#include <poll.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "command.h"
#include "glint/image/picture_layers.h"
#include "glint/image/read_image.h"
#include "gltf_text.h"
#include "scenes.h"

namespace glint::test::batch_cli_test {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

using Json = nlohmann::json;

const std::string sphere = shipped + "sphere.glb", torus = shipped + "torus.glb";

/// A cube that is quick to draw; with a material so that two can differ.
std::string cube(const std::string& name, const Folder& folder) {
  glint::Mesh mesh = glint::test::sphere(4, 2);
  return glint::test::writeGltf(name, mesh, nullptr, folder.path());
}

std::string listOf(const Folder& folder, const std::vector<std::string>& lines) {
  std::ofstream list(folder / "list");
  for (const std::string& line : lines) list << line << "\n";
  return folder / "list";
}

std::vector<Json> jsonLines(const std::string& text) {
  std::vector<Json> lines;
  for (const std::string& line : linesOf(text)) lines.push_back(Json::parse(line));
  return lines;
}

std::vector<std::string> tiny(std::vector<std::string> arguments) {
  arguments.insert(arguments.end(), {"--resolution", "32,32"});
  return quick(arguments);
}

/// The binary with pipes for stdin and stdout.
class Running {
 public:
  explicit Running(const std::vector<std::string>& arguments) {
    int in[2], out[2];
    EXPECT_EQ(pipe2(in, O_CLOEXEC), 0);
    EXPECT_EQ(pipe2(out, O_CLOEXEC), 0);
    child_ = fork();
    if (child_ == 0) {
      dup2(in[0], 0);
      dup2(out[1], 1);
      dup2(open("/dev/null", O_WRONLY), 2);
      std::vector<char*> argv{const_cast<char*>(GLINT_EXECUTABLE)};
      for (const std::string& a : arguments) argv.push_back(const_cast<char*>(a.c_str()));
      argv.push_back(nullptr);
      execv(GLINT_EXECUTABLE, argv.data());
      _exit(127);
    }
    close(in[0]);
    close(out[1]);
    in_ = in[1];
    out_ = out[0];
  }
  ~Running() {
    if (child_ > 0) {
      kill(child_, SIGKILL);
      waitpid(child_, nullptr, 0);
    }
    closeIn();
    close(out_);
  }
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;

  void write(const std::string& text) {
    EXPECT_EQ(::write(in_, text.data(), text.size()), ssize_t(text.size()));
  }
  void closeIn() {
    if (in_ >= 0) close(in_);
    in_ = -1;
  }
  void signal(int number) { kill(child_, number); }

  /// The next line of its output; empty at the end or on a timeout.
  std::string line(int seconds = 30) {
    for (;;) {
      const auto end = text_.find('\n');
      if (end != std::string::npos) {
        const std::string first = text_.substr(0, end);
        text_.erase(0, end + 1);
        return first;
      }
      pollfd ready{out_, POLLIN, 0};
      if (poll(&ready, 1, seconds * 1000) <= 0) return "";
      char bytes[4096];
      const ssize_t count = read(out_, bytes, sizeof bytes);
      if (count <= 0) return "";
      text_.append(bytes, std::size_t(count));
    }
  }
  /// Its exit status, or minus the signal that ended it.
  int wait() {
    int status = 0;
    waitpid(child_, &status, 0);
    child_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }

 private:
  pid_t child_ = -1;
  int in_ = -1, out_ = -1;
  std::string text_;
};

// A model from a pipe gives the same picture as its file, and errors name it as stdin.
TEST(Stdin, IsAModel) {
  Folder folder("stdin");
  ASSERT_EQ(runGlint(tiny({"render", sphere, "-o", folder / "file.png"})).status, 0);
  for (const std::string name : {"-", "/dev/stdin"}) {
    Running piped(tiny({"render", name, "-o", folder / "{model}.png"}));
    piped.write(contents(sphere));
    piped.closeIn();
    EXPECT_EQ(piped.wait(), 0);
    EXPECT_EQ(glint::readImage(folder / "stdin.png").values,
              glint::readImage(folder / "file.png").values);
    std::filesystem::remove(folder / "stdin.png");
  }
  Running info({"info", "-"});
  info.write(contents(sphere));
  info.closeIn();
  EXPECT_THAT(info.line(), testing::StartsWith("stdin: "));
  EXPECT_EQ(info.wait(), 0);

  for (const std::string command : {"render", "info"}) {
    std::vector<std::string> arguments{command, "-"};
    if (command == "render") arguments = tiny({"render", "-", "-o", folder / "none.png"});
    const Ran empty = runGlint(arguments);
    EXPECT_EQ(empty.status, 2);
    EXPECT_THAT(empty.err, HasSubstr("stdin: is empty: give a .gltf or .glb file"));
  }
  const Ran list = runGlint(
      tiny({"render", "--from-list", listOf(folder, {sphere}), "-o", folder / "{folder}.png"}));
  EXPECT_EQ(list.status, 0) << list.err;
  EXPECT_THAT(folder.names(), ElementsAre("file.png", "list", "models.png"));
}

TEST(Stdin, IsConvertedAndStudied) {
  Folder folder("stdin-others");
  const auto convert = [&](const std::string& in, const std::string& out) {
    return std::vector<std::string>{"convert", in, out, "--material", "exponent=77"};
  };
  ASSERT_EQ(runGlint(convert(sphere, folder / "file.glb")).status, 0);
  Running piped(convert("-", folder / "piped.glb"));
  piped.write(contents(sphere));
  piped.closeIn();
  EXPECT_EQ(piped.wait(), 0);
  EXPECT_EQ(contents(folder / "piped.glb"), contents(folder / "file.glb"));
  const Ran empty = runGlint(convert("-", folder / "none.glb"));
  EXPECT_EQ(empty.status, 2);
  EXPECT_THAT(empty.err, HasSubstr("stdin: is empty"));
  Running wrong(convert("-", folder / "none.gltf"));  // a GLB stays one
  wrong.write(contents(sphere));
  wrong.closeIn();
  EXPECT_EQ(wrong.wait(), 2);

  Running study({"study", "-", "--quick", "--repetitions", "2", "--resolution", "16,16",
                 "--shading", "phong", "--highlight", "exact", "--rendering-backend", "osmesa",
                 "--json", folder / "study.json"});
  study.write(contents(sphere));
  study.closeIn();
  while (!study.line(60).empty()) continue;
  EXPECT_EQ(study.wait(), 0);
  EXPECT_THAT(contents(folder / "study.json"), HasSubstr("\"stdin\""));
  EXPECT_THAT(folder.names(), ElementsAre("file.glb", "piped.glb", "study.json"));
}

TEST(Stdin, IsNotTheListAndAModelOfIt) {
  Folder folder("stdin-list");
  Running both(tiny({"render", "--from-list", "-", "-o", folder / "{n}.png"}));
  both.write("-\n" + sphere + "\n");
  both.closeIn();
  EXPECT_EQ(Json::parse(both.line())["status"], 2);
  EXPECT_EQ(Json::parse(both.line())["status"], 0);
  EXPECT_EQ(both.wait(), 2);
}

TEST(List, EachLineIsAPictureAndALineOfJson) {
  Folder folder("list");
  const std::string list = listOf(
      folder, {"\xEF\xBB\xBF" + sphere, "", torus + "\t" + (folder / "own.png"), sphere + "\r"});
  const Ran ran = runGlint(tiny({"render", "--from-list", list, "-o", folder / "{n}-{model}.png"}));
  EXPECT_EQ(ran.status, 0) << ran.err;
  EXPECT_THAT(ran.err, IsEmpty());
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
  const Ran ran = runGlint(tiny(
      {"render", "--from-list", list, "-o", folder / "{n}.png", "--json", folder / "report.json"}));
  EXPECT_EQ(ran.status, 2);
  EXPECT_EQ(jsonLines(ran.out).size(), 3u);
  const Json report = Json::parse(contents(folder / "report.json"));
  EXPECT_EQ(report["backend"], "osmesa");
  EXPECT_TRUE(report["gl"]["renderer"].is_string());
  ASSERT_EQ(report["pictures"].size(), 3u);
  EXPECT_EQ(report["pictures"][1]["status"], 2);
  // `--json -` is the default for stdout.
  const Ran lines =
      runGlint(tiny({"render", "--from-list", list, "-o", folder / "{n}.png", "--json", "-"}));
  EXPECT_EQ(jsonLines(lines.out).size(), 3u);
}

TEST(List, AFailedModelDoesNotStopTheRest) {
  Folder folder("list_failed");
  std::ofstream(folder / "broken.glb") << "glTF but not really";
  std::vector<std::string> models{sphere, folder / "broken.glb", folder / "none.glb", folder.path(),
                                  torus};
  const std::string list = listOf(folder, models);
  for (const bool fromList : {true, false}) {
    std::vector<std::string> arguments{"render"};
    if (fromList)
      arguments.insert(arguments.end(), {"--from-list", list});
    else
      arguments.insert(arguments.end(), models.begin(), models.end());
    arguments.insert(arguments.end(), {"-o", folder / "{n}.png"});
    const Ran ran = runGlint(tiny(arguments));
    EXPECT_EQ(ran.status, 2);
    EXPECT_EQ(ran.errorLines().size(), 3u) << ran.err;
    EXPECT_THAT(folder.names(), ElementsAre("0.png", "4.png", "broken.glb", "list"));
    if (!fromList) continue;
    std::vector<int> statuses;
    for (const Json& line : jsonLines(ran.out)) statuses.push_back(line["status"]);
    EXPECT_THAT(statuses, ElementsAre(0, 2, 2, 2, 0));
  }
}

// The first picture is reported before the second line is written.
TEST(List, FromAPipeEachPictureIsMadeAsSoonAsItsLineIsThere) {
  Folder folder("stream");
  Running run(tiny({"render", "--from-list", "-", "-o", folder / "{n}.png"}));
  for (const char* name : {"000000.png", "000001.png", "000002.png"}) {
    run.write(sphere + "\n");
    const std::string line = run.line();
    ASSERT_FALSE(line.empty());
    EXPECT_EQ(Json::parse(line)["output"], folder / name);
    EXPECT_EQ(glint::readImage(folder / name).width, 32);
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
  const Ran ran = runGlint(tiny({"render", "--from-list", list, "-o", folder / "{model}.png"}));
  EXPECT_EQ(ran.status, 2);
  EXPECT_THAT(ran.err, AllOf(HasSubstr("model 0"), HasSubstr("sphere.png"), HasSubstr("{n}")));
  EXPECT_THAT(ran.out, IsEmpty());
  EXPECT_THAT(folder.names(), ElementsAre("list"));
  // A pipe cannot be scanned beforehand: only the second one fails.
  Running run(tiny({"render", "--from-list", "-", "-o", folder / "{model}.png"}));
  run.write(sphere + "\n" + sphere + "\n" + torus + "\n");
  run.closeIn();
  EXPECT_EQ(Json::parse(run.line())["status"], 0);
  EXPECT_EQ(Json::parse(run.line())["status"], 2);
  EXPECT_EQ(Json::parse(run.line())["status"], 0);
  EXPECT_EQ(run.wait(), 2);
}

TEST(List, AnEmptyOneIsNoErrorButSaysSo) {
  Folder folder("list_empty");
  const Ran ran =
      runGlint(tiny({"render", "--from-list", listOf(folder, {""}), "-o", folder / "a.png"}));
  EXPECT_EQ(ran.status, 0);
  EXPECT_EQ(ran.errorLines().size(), 1u);
  EXPECT_THAT(ran.err, HasSubstr("no models"));
}

TEST(Shard, PartsAreDisjointAndTogetherAll) {
  Folder folder("shards");
  std::vector<std::string> models(11, cube("cube", folder));
  const std::string list = listOf(folder, models);
  std::multiset<std::string> drawn;
  for (const char* shard : {"1/4", "2/4", "3/4", "4/4"}) {
    const Ran ran =
        runGlint(tiny({"render", "--from-list", list, "-o", folder / "{n}.png", "--shard", shard}));
    EXPECT_EQ(ran.status, 0) << ran.err;
    const auto lines = jsonLines(ran.out);
    EXPECT_EQ(lines.size(), shard == std::string("4/4") ? 2u : 3u);
    for (const Json& line : lines) drawn.insert(line["output"]);
  }
  EXPECT_EQ(drawn.size(), 11u);
  EXPECT_EQ(std::set<std::string>(drawn.begin(), drawn.end()).size(), 11u);
  EXPECT_EQ(drawn.count(folder / "10.png"), 1u);
  // For a single model, the pictures are divided.
  std::size_t frames = 0;
  for (const char* shard : {"1/2", "2/2"}) {
    const Ran ran = runGlint(tiny({"render", models[0], "-o", folder / "t{frame}.png",
                                   "--turntable", "5", "--shard", shard, "--json", "-"}));
    frames += Json::parse(ran.out)["pictures"].size();
  }
  EXPECT_EQ(frames, 5u);
}

TEST(Resume, SkipsWhatIsDoneWithTheSameModelAndLook) {
  Folder folder("resume");
  const std::string a = cube("a", folder), b = cube("b", folder);
  const std::string list = listOf(folder, {a, b});
  const auto skipped = [&](std::vector<std::string> more = {}) {
    std::vector<std::string> arguments{"render", "--from-list",          list,
                                       "-o",     folder / "{model}.png", "--resume"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Ran ran = runGlint(tiny(arguments));
    EXPECT_EQ(ran.status, 0) << ran.err;
    std::vector<bool> all;
    for (const Json& line : jsonLines(ran.out)) all.push_back(line.contains("skipped"));
    return all;
  };
  EXPECT_THAT(skipped(), ElementsAre(false, false));
  const std::string bytes = contents(folder / "a.png");
  EXPECT_THAT(skipped(), ElementsAre(true, true));
  EXPECT_EQ(contents(folder / "a.png"), bytes);
  // Another look or another depth: everything is made again.
  EXPECT_THAT(skipped({"--exposure", "1"}), ElementsAre(false, false));
  EXPECT_THAT(skipped({"--exposure", "1"}), ElementsAre(true, true));
  EXPECT_THAT(skipped({"--bit-depth", "16"}), ElementsAre(false, false));
  EXPECT_THAT(skipped(), ElementsAre(false, false));
  // A model, or a file that it refers to, has changed.
  {
    std::fstream bin(folder / "a.bin", std::ios::in | std::ios::out | std::ios::binary);
    bin.seekp(3);
    bin.put('\x3e');
  }
  EXPECT_THAT(skipped(), ElementsAre(false, true));
  std::ofstream(b, std::ios::app) << "\n";
  EXPECT_THAT(skipped(), ElementsAre(true, false));
  // A picture that is damaged, or not ours.
  std::ofstream(folder / "b.png") << bytes.substr(0, 60);
  EXPECT_THAT(skipped(), ElementsAre(true, false));
  std::filesystem::remove(folder / "a.png");
  EXPECT_THAT(skipped(), ElementsAre(false, true));
}

TEST(Resume, OfATurntableAndOfExr) {
  Folder folder("resume_turntable");
  const auto skipped = [&](const std::string& frames) {
    const Ran ran = runGlint(tiny({"render", sphere, "-o", folder / "{frame}.exr", "--turntable",
                                   frames, "--resume", "--json", "-"}));
    EXPECT_EQ(ran.status, 0) << ran.err;
    std::vector<bool> all;
    const Json report = Json::parse(ran.out);
    for (const Json& each : report["pictures"]) all.push_back(each.contains("skipped"));
    return all;
  };
  EXPECT_THAT(skipped("3"), ElementsAre(false, false, false));
  std::filesystem::remove(folder / "1.exr");
  EXPECT_THAT(skipped("3"), ElementsAre(true, false, true));
  EXPECT_THAT(skipped("4"), ElementsAre(false, false, false, false));
}

// 1000 pictures, interrupted in the middle, then resumed: pictures reported as done are not made
// again, and in the end all are there.
TEST(Resume, ABatchOfAThousandKilledInTheMiddleLosesAndRepeatsNothing) {
  for (const int number : {SIGKILL, SIGINT, SIGTERM}) {
    Folder folder("killed");
    std::filesystem::create_directories(folder / "out");
    const std::string list = listOf(folder, std::vector<std::string>(1000, cube("cube", folder)));
    const std::vector<std::string> command =
        tiny({"render", "--from-list", list, "-o", folder / "out/{n}.png", "--resume"});
    std::set<std::string> told;
    {
      Running run(command);
      for (int i = 0; i < 400; ++i) told.insert(Json::parse(run.line())["output"]);
      run.signal(number);
      for (std::string line = run.line(); !line.empty(); line = run.line())
        told.insert(Json::parse(line)["output"]);
      EXPECT_EQ(run.wait(), number == SIGKILL ? -SIGKILL : 128 + number);
    }
    EXPECT_GE(told.size(), 400u);
    EXPECT_LT(told.size(), 1000u);
    // Every file is complete; unreported files are at most those that were in progress.
    std::set<std::string> there;
    for (const auto& file : std::filesystem::directory_iterator(folder / "out")) {
      there.insert(file.path().string());
      EXPECT_EQ(glint::readImage(file.path().string()).width, 32);
    }
    EXPECT_TRUE(std::includes(there.begin(), there.end(), told.begin(), told.end()));
    EXPECT_LE(there.size(), told.size() + (number == SIGKILL ? 1 : 0));

    const Ran rest = runGlint(command);
    EXPECT_EQ(rest.status, 0) << rest.err;
    std::set<std::string> skipped, drawn;
    for (const Json& line : jsonLines(rest.out))
      (line.contains("skipped") ? skipped : drawn).insert(line["output"]);
    EXPECT_EQ(skipped, there);
    EXPECT_EQ(drawn.size(), 1000 - there.size());
    std::size_t files = 0;
    for (const auto& file : std::filesystem::directory_iterator(folder / "out"))
      files += file.path().extension() == ".png";
    EXPECT_EQ(files, 1000u);
  }
}

TEST(Interrupt, EndsARunThatWaitsForItsList) {
  Folder folder("waiting");
  Running run(tiny({"render", "--from-list", "-", "-o", folder / "{n}.png"}));
  run.write(sphere + "\n");
  EXPECT_FALSE(run.line().empty());
  run.signal(SIGINT);
  EXPECT_EQ(run.wait(), 130);
  EXPECT_THAT(folder.names(), ElementsAre("000000.png"));
}

TEST(Batch, ReferencesAreComparedAtOnce) {
  Folder folder("references");
  std::filesystem::create_directories(folder / "baseline");
  const auto run = [&](std::vector<std::string> more) {
    std::vector<std::string> arguments{"render",
                                       sphere,
                                       torus,
                                       "-o",
                                       folder / "{model}.png",
                                       "--reference",
                                       folder / "baseline/{model}.png",
                                       "--json",
                                       folder / "report.json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const int status = runGlint(tiny(arguments)).status;
    std::vector<int> each;
    const Json report = Json::parse(contents(folder / "report.json"));
    for (const Json& p : report["pictures"]) each.push_back(p["status"]);
    EXPECT_EQ(each.size(), 2u);
    each.insert(each.begin(), status);
    return each;
  };
  EXPECT_THAT(run({}), ElementsAre(4, 4, 4));
  std::filesystem::copy_file(folder / "sphere.png", folder / "baseline/sphere.png");
  EXPECT_THAT(run({}), ElementsAre(4, 0, 4));
  std::filesystem::copy_file(folder / "torus.png", folder / "baseline/torus.png");
  EXPECT_THAT(run({}), ElementsAre(0, 0, 0));
  const std::vector<std::string> darker{"--exposure", "-0.1"};
  EXPECT_THAT(run(darker), ElementsAre(1, 1, 1));
  EXPECT_THAT(run({darker[0], darker[1], "--reference-threshold", "0.5"}), ElementsAre(0, 0, 0));
  EXPECT_THAT(run({darker[0], darker[1], "--reference-threshold", "0.0001"}), ElementsAre(1, 1, 1));
  // A picture that is there already is not drawn anew, but compared all the same.
  EXPECT_THAT(run({darker[0], darker[1], "--resume"}), ElementsAre(1, 1, 1));
  EXPECT_THAT(run({"--resume"}), ElementsAre(0, 0, 0));
  EXPECT_THAT(run({"--resume"}), ElementsAre(0, 0, 0));
  std::ofstream(folder / "baseline/torus.png") << "no picture";
  EXPECT_THAT(run({}), ElementsAre(2, 0, 2));
  EXPECT_THAT(run({"--resume"}), ElementsAre(2, 0, 2));
  EXPECT_THAT(run(darker), ElementsAre(2, 1, 2));
}

// The files of --terms add up to the picture, by GL and by the reference, and the layers of an EXR
// have the same values.
TEST(Terms, FilesAddUpAndLayersAreTheSame) {
  Folder folder("terms");
  for (const char* backend : {"osmesa", "reference"}) {
    const auto draw = [&](const std::string& output) {
      const Ran ran = runGlint({"render",
                                sphere,
                                "-o",
                                output,
                                "--terms",
                                "--resolution",
                                "32,32",
                                "--shading",
                                "environment",
                                "--light",
                                "camera:0.5,0.6,0.7",
                                "--light",
                                "point:1,2,3",
                                "--material",
                                "specular=0.8,exponent=9",
                                "--anti-aliasing",
                                "none",
                                "--rendering-backend",
                                backend,
                                "--json",
                                "-"});
      EXPECT_EQ(ran.status, 0) << ran.err;
      return Json::parse(ran.out)["pictures"][0]["terms"];
    };
    const Json terms = draw(folder / "a.pfm");
    ASSERT_EQ(terms.size(), 12u);
    EXPECT_EQ(terms["diffuse-1"], folder / "a.diffuse-1.pfm");
    draw(folder / "a.exr");
    const glint::Image picture = glint::readImage(folder / "a.pfm");
    std::vector<double> sum(picture.values.size());
    for (const auto& [name, path] : terms.items()) {
      const glint::Image image = glint::readImage(path);
      if (name == "id") {
        // One object with one mesh and one material, or none.
        for (std::size_t i = 0; i < image.values.size(); i += 4)
          for (std::size_t c = 0; c < 3; ++c) {
            ASSERT_EQ(image.values[i + c], image.values[i]);
            ASSERT_TRUE(image.values[i] == 0 || image.values[i] == -1);
          }
        const auto layers = glint::readPictureLayers(folder / "a.exr", "id.mesh").layers;
        ASSERT_EQ(layers.size(), 1u);
        const auto& codes = std::get<2>(layers[0].image.values);
        const std::size_t channels = std::size_t(layers[0].image.channels);
        for (std::size_t i = 0; i < 32 * 32; ++i)
          ASSERT_EQ(codes[channels * i], image.values[4 * i]);
        continue;
      }
      if (name != "normal") {
        const glint::Image layer = glint::readImage(folder / "a.exr", name);
        EXPECT_EQ(layer.values, image.values) << name;
      }
      if (name == "normal" || name == "depth") continue;
      for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += double(image.values[i]);
    }
    // Nine terms with a few roundings each, of values up to 4.
    for (std::size_t i = 0; i < sum.size(); ++i)
      if (i % 4 != 3) {
        ASSERT_NEAR(sum[i], double(picture.values[i]), 9 * 4 * 4 * 6e-8) << i;
      }
  }
  // The picture itself is the same as without the option.
  EXPECT_EQ(runGlint({"render", sphere, "-o", folder / "b.pfm", "--resolution", "32,32",
                      "--shading", "environment", "--light", "camera:0.5,0.6,0.7", "--light",
                      "point:1,2,3", "--material", "specular=0.8,exponent=9", "--anti-aliasing",
                      "none", "--rendering-backend", "reference"})
                .status,
            0);
  EXPECT_EQ(contents(folder / "a.pfm"), contents(folder / "b.pfm"));
}

TEST(Sweep, IsASheetOfThePicturesThatItsStepsGive) {
  Folder folder("sweep");
  const auto draw = [&](const std::string& name, std::vector<std::string> more) {
    std::vector<std::string> arguments{"render", sphere, "-o", folder / name};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Ran ran = runGlint(tiny(arguments));
    EXPECT_EQ(ran.status, 0) << ran.err;
    return glint::readImage(folder / name);
  };
  // Logarithmic: 1, 10, 100.
  const std::vector<std::string> sweeps{"--sweep", "exponent=1:100:3", "--sweep",
                                        "exposure=-1:1:2"};
  const glint::Image sheet = draw("sheet.pfm", sweeps);
  const int gap = 2, across = 32 + gap, down = sheet.height / 2;
  ASSERT_EQ(sheet.width, 3 * across + gap);
  const char* exponents[] = {"1", "10", "100"};
  for (int row = 0; row < 2; ++row)
    for (int column = 0; column < 3; ++column) {
      const glint::Image cell =
          draw("cell.pfm", {"--material", std::string("exponent=") + exponents[column],
                            "--exposure", row ? "1" : "-1"});
      for (int y = 0; y < 32; ++y)
        for (int i = 0; i < 4 * 32; ++i)
          ASSERT_EQ(sheet.row(row * down + gap + y)[4 * (column * across + gap) + i],
                    cell.row(y)[i])
              << row << " " << column;
      // There is a label below.
      float label = 0;
      for (int y = 32 + gap; y < down; ++y)
        for (int x = 0; x < 32; ++x)
          label += sheet.row(row * down + y)[4 * (column * across + gap + x)];
      EXPECT_GT(label, 20);
    }
  EXPECT_EQ(draw("named.png", {"--sweep", "camera-azimuth-angle=0:90:7:linear"}).width,
            3 * across + gap);
}

// A sphere that moves by 2 along x within a second.
TEST(Frames, AreMomentsOfTheAnimationBeforeOneCamera) {
  Folder folder("frames");
  const std::string model = glint::test::writeGltf(
      "moving", glint::test::sphere(12, 8),
      [](Json& json) {
        json["buffers"].push_back(
            {{"byteLength", 32},
             {"uri",
              "data:application/"
              "octet-stream;base64,AAAAAAAAgD8AAAAAAAAAAAAAAAAAAABAAAAAAAAAAAA="}});
        json["bufferViews"].push_back({{"buffer", 1}, {"byteLength", 8}});
        json["bufferViews"].push_back({{"buffer", 1}, {"byteOffset", 8}, {"byteLength", 24}});
        json["accessors"].push_back({{"bufferView", 3},
                                     {"componentType", 5126},
                                     {"count", 2},
                                     {"type", "SCALAR"},
                                     {"min", {0}},
                                     {"max", {1}}});
        json["accessors"].push_back(
            {{"bufferView", 4}, {"componentType", 5126}, {"count", 2}, {"type", "VEC3"}});
        json["animations"] = {
            {{"name", "glide"},
             {"samplers", {{{"input", 3}, {"output", 4}}}},
             {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}}};
      },
      folder.path());
  const Ran ran = runGlint(tiny({"render", model, "-o", folder / "{frame}.png", "--frames", "4",
                                 "--camera-direction", "0,0,-1"}));
  EXPECT_EQ(ran.status, 0) << ran.err;
  // The centre of the model moves to the right by one step per frame.
  std::vector<double> places;
  Json camera;
  for (int i = 0; i < 4; ++i) {
    const std::string name = folder / (std::to_string(i) + ".png");
    const glint::Image image = glint::readImage(name);
    double sum = 0, weight = 0;
    for (int y = 0; y < 32; ++y)
      for (int x = 0; x < 32; ++x) {
        const double seen = std::abs(image.row(y)[4 * x] - image.values[0]) > 1e-3;
        sum += x * seen;
        weight += seen;
      }
    ASSERT_GT(weight, 20);
    places.push_back(sum / weight);
    // Each records how it was made, and its look reproduces it.
    const Json look = Json::parse(glint::readPictureText(name).at("glint-look"));
    EXPECT_EQ(look["animation-time"], 0.25 * i);
    if (i > 0) {
      EXPECT_EQ(look["camera-position"], camera);
    }
    camera = look["camera-position"];
    EXPECT_EQ(runGlint({"render", model, "-o", folder / "again.png", "--look", name,
                        "--rendering-backend", "osmesa"})
                  .status,
              0);
    EXPECT_EQ(glint::readImage(folder / "again.png").values, image.values);
  }
  for (int i = 1; i < 4; ++i)
    EXPECT_NEAR(places[std::size_t(i)] - places[std::size_t(i - 1)], places[1] - places[0], 0.6);
  EXPECT_GT(places[1] - places[0], 1);
  const Ran still =
      runGlint(tiny({"render", sphere, "-o", folder / "s{frame}.png", "--frames", "2"}));
  EXPECT_EQ(still.status, 2);
  EXPECT_THAT(still.err, HasSubstr("no animation"));
}

TEST(Sweep, WrongOnesAreRefused) {
  Folder folder("wrong_sweeps");
  const std::pair<const char*, const char*> cases[] = {
      {"shine=1:2:3", "no numeric parameter"}, {"exponent", "KEY=FROM:TO:STEPS"},
      {"exponent=1:2", "KEY=FROM:TO:STEPS"},   {"exponent=1:2:1", "steps"},
      {"exponent=1:2:2.5", "steps"},           {"exponent=1:2:9999", "steps"},
      {"exponent=0:2:3", ":linear"},           {"exponent=1:2:3:even", "neither"},
      {"exponent=1:1e9:3", "exponent"},        {"metalness=0:2:3", "metalness"},
      {"exponent=a:2:3", "KEY=FROM:TO"},       {"shading=0:1:2", "no numeric parameter"},
      {"ior=1:nan:3", "KEY=FROM:TO"}};
  for (const auto& [sweep, expected] : cases) {
    const Ran ran = runGlint(tiny({"render", sphere, "-o", folder / "a.png", "--sweep", sweep}));
    EXPECT_EQ(ran.status, 2) << sweep;
    EXPECT_EQ(ran.errorLines().size(), 1u) << ran.err;
    EXPECT_THAT(ran.err, HasSubstr(expected)) << sweep;
  }
  const Ran named =
      runGlint(tiny({"render", sphere, "-o", folder / "a.png", "--sweep", "Nobody:ior=1:2:3"}));
  EXPECT_EQ(named.status, 2);
  EXPECT_THAT(named.err, HasSubstr("Nobody"));
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(Batch, OptionsThatExcludeEachOther) {
  Folder folder("exclude");
  const std::string list = listOf(folder, {sphere}), out = folder / "{n}.png";
  const std::pair<std::vector<std::string>, const char*> cases[] = {
      {{"-o", out}, "MODEL"},
      {{sphere, "--from-list", list, "-o", out}, "--from-list"},
      {{"--from-list", list, "-o", "-"}, "-o -"},
      {{"--from-list", folder / "none", "-o", out}, "none"},
      {{"--from-list", folder.path(), "-o", out}, "directory"},
      {{sphere, "-o", folder / "a.pfm", "--resume"}, ".pfm"},
      {{sphere, "-o", out, "--shard", "0/2"}, "--shard"},
      {{sphere, "-o", out, "--shard", "3/2"}, "--shard"},
      {{sphere, "-o", out, "--shard", "1"}, "--shard"},
      {{sphere, "-o", out, "--shard", "1/2x"}, "--shard"},
      {{sphere, "-o", out, "--jobs", "0"}, "--jobs"},
      {{sphere, "-o", out, "--turntable", "0"}, "--turntable"},
      {{sphere, "-o", out, "--turntable", "2"}, "{frame}"},
      {{sphere, "-o", out, "--frames", "2"}, "{frame}"},
      {{sphere, "-o", folder / "{frame}.png", "--frames", "2", "--turntable", "3"}, "same number"},
      {{sphere, "-o", folder / "{frame}.png"}, "--turntable"},
      {{sphere, "-o", out, "--reference-threshold", "1"}, "--reference"},
      {{sphere, "-o", "-", "--reference", "a.png"}, "--reference"},
      {{sphere, "-o", "-", "--terms"}, "--terms"},
      {{sphere, "-o", out, "--terms", "--sweep", "ior=1:2:3"}, "--sweep"},
      {{sphere, "-o", out, "--sweep", "ior=1:2:3", "--sweep", "ior=1:2:3", "--sweep", "ior=1:2:3"},
       "--sweep"},
      {{sphere, torus, "-o", "-"}, "would both become"}};
  for (const auto& [options, expected] : cases) {
    std::vector<std::string> arguments{"render"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Ran ran = runGlint(tiny(arguments));
    EXPECT_EQ(ran.status, 2) << testing::PrintToString(options);
    ASSERT_EQ(ran.errorLines().size(), 1u) << ran.err;
    EXPECT_THAT(ran.err, HasSubstr(expected));
    EXPECT_THAT(ran.out, IsEmpty());
  }
  EXPECT_THAT(folder.names(), ElementsAre("list"));
}

}  // namespace glint::test::batch_cli_test
