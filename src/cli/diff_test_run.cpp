#include "diff_test_run.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <sstream>

#include "commands.h"
#include "diff_baselines.h"
#include "diff_layers.h"
#include "diff_pair.h"
#include "glint/image/error.h"
#include "glint/image/file.h"
#include "report_pictures.h"

namespace glint {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

bool isFile(const std::string& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

/// A file's text, truncated to its end if it is long; empty if it does not exist.
std::string textIn(const std::string& path, std::size_t most = 1 << 20) {
  if (!isFile(path)) return "";
  const std::vector<std::byte> bytes = readFile(path);
  const std::size_t from = bytes.size() > most ? bytes.size() - most : 0;
  return {reinterpret_cast<const char*>(bytes.data()) + from, bytes.size() - from};
}

std::vector<std::string> linesIn(const std::string& path) {
  std::istringstream in(textIn(path));
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// The result of a test according to how far it came.
Json pairOf(const std::string& folder, const std::string& file, const TestRecord& record,
            const std::vector<std::string>& options) {
  std::istringstream status(textIn(folder + "/status/" + file + ".txt"));
  std::string stage;
  int number = 0;
  status >> stage >> number;
  Json pair;
  if (stage == "compared" || stage == "updated") {
    const std::string text = textIn(folder + "/result/" + file + ".json", std::size_t(1) << 30);
    pair = Json::parse(text, nullptr, false);
    if (!pair.is_object() || !pair.contains("status") || !pair["status"].is_number_integer())
      pair = Json::object();
  }
  std::string error;
  if (stage.empty()) {
    error = "the test has not run";
  } else if (stage == "started") {
    error = "the test did not end: it was killed, or took too long";
  } else if (stage == "command") {
    error = number > 128 && number < 256
                ? "the program crashed (signal " + std::to_string(number - 128) + ")"
                : "the program ended with status " + std::to_string(number);
  } else if (stage == "nothing") {
    error = "the program did not write its picture";
  } else if (pair.empty()) {
    error = "the comparison left no result";
  }
  if (!error.empty()) pair = Json{{"status", int(unusable)}, {"error", error}};
  pair["name"] = record.name;
  pair["a"] = isFile(record.baseline) ? record.baseline : "";
  pair["b"] = record.actual;
  pair.erase("glint");
  pair["conditions"] = options;
  if (const std::string log = textIn(folder + "/log/" + file + ".txt", 20000); !log.empty())
    pair["log"] = log;
  return pair;
}

/// The file names of the masks among options.
void addMasks(const std::vector<std::string>& options, std::set<std::string>& names) {
  for (std::size_t i = 0; i < options.size(); ++i) {
    if (options[i].starts_with("--mask="))
      names.insert(fs::path(options[i].substr(7)).filename().string());
    if (options[i] == "--mask" && i + 1 < options.size())
      names.insert(fs::path(options[i + 1]).filename().string());
  }
}

/// Pictures in the folders of the tests' baselines that belong to no test. A folder that holds
/// anything other than pictures and folders is not only for baselines and nothing in it is listed,
/// because what is listed may be pruned.
std::vector<std::string> unusedBaselines(const std::vector<TestRecord>& records,
                                         const std::set<std::string>& masks) {
  std::set<std::string> used, folders;
  for (const TestRecord& record : records) {
    used.insert(fs::path(record.baseline).lexically_normal().string());
    for (const std::string& other : otherBaselines(record.baseline))
      used.insert(fs::path(other).lexically_normal().string());
    folders.insert(fs::path(record.baseline).parent_path().string());
  }
  std::vector<std::string> unused;
  std::error_code ignored;
  for (const std::string& folder : folders) {
    std::vector<std::string> found;
    bool pictures = true;
    for (const auto& file : fs::directory_iterator(folder, ignored)) {
      const fs::path path = file.path().lexically_normal();
      const std::string name = path.filename().string();
      if (file.is_directory(ignored) || name.starts_with('.')) continue;
      if (!isPictureName(path.string()))
        pictures = false;
      else if (used.count(path.string()) == 0 && masks.count(name) == 0)
        found.push_back(path.string());
    }
    if (pictures) unused.insert(unused.end(), found.begin(), found.end());
  }
  std::sort(unused.begin(), unused.end());
  return unused;
}

}  // namespace

TestRun readTestRun(const std::string& folder) {
  std::vector<std::string> files;
  std::error_code ignored;
  for (const auto& file : fs::directory_iterator(folder + "/tests", ignored))
    if (file.path().extension() == ".txt") files.push_back(file.path().stem().string());
  if (files.empty())
    throw InputError("--run " + printablePath(folder) +
                     ": no image tests found: give the folder image-tests of a build folder");
  std::sort(files.begin(), files.end());
  TestRun run;
  run.pairs = Json::array();
  std::set<std::string> masks;
  for (const std::string& file : files) {
    const std::vector<std::string> lines = linesIn(folder + "/tests/" + file + ".txt");
    if (lines.size() < 3)
      throw InputError("--run " + printablePath(folder) + ": tests/" + printablePath(file) +
                       ".txt is damaged: configure the project again");
    TestRecord record{lines[0], lines[1], "", "", ""};
    const auto ifThere = [](const std::string& path) {
      return isFile(path) ? path : std::string();
    };
    record.actual = ifThere(folder + "/actual/" + file + lines[2]);
    record.kept = ifThere(folder + "/baseline/" + file + lines[2]);
    record.difference = ifThere(folder + "/difference/" + file + ".png");
    const std::vector<std::string> options(lines.begin() + 3, lines.end());
    addMasks(options, masks);
    Json pair = pairOf(folder, file, record, options);
    DiffEntry entry;
    entry.name = record.name;
    entry.a = pair["a"].get<std::string>();
    entry.b = record.actual;
    entry.status = pair["status"].get<int>();
    // A test that did not compare has no picture to accept, even if a file exists.
    entry.readableB = !entry.b.empty() && (entry.status == differs || entry.status == noBaseline);
    run.records.push_back(record);
    run.entries.push_back(entry);
    run.pairs.push_back(std::move(pair));
  }
  run.unused = unusedBaselines(run.records, masks);
  return run;
}

PairPictures picturesOf(const TestRecord& record, const DiffEntry& entry, const Json& pair) {
  PairPictures pictures;
  std::string wanted = textOf(pair, "shown");
  if (wanted.empty()) wanted = textOf(pair, "layer");
  struct Side {
    std::string path;
    std::vector<std::byte>*picture, *values;
    std::vector<std::byte> bytes;
    PictureLayers read;
  };
  Side sides[] = {
      {record.kept.empty() ? entry.a : record.kept, &pictures.a, &pictures.valuesA, {}, {}},
      {record.actual, &pictures.b, &pictures.valuesB, {}, {}}};
  std::pair<float, float> range{INFINITY, -INFINITY};
  for (Side& side : sides) {
    if (side.path.empty()) continue;
    try {
      side.bytes = readFile(side.path);
      side.read = decodePictureLayers(side.bytes, side.path, wanted.empty() ? "main" : wanted);
    } catch (const InputError&) {
      side.read.layers.clear();
      continue;  // the other picture is still shown
    }
    const auto [low, high] = rangeOf(side.read.layers[0].image);
    range = {std::min(range.first, low), std::max(range.second, high)};
  }
  for (const Side& side : sides) {
    if (side.read.layers.empty()) continue;
    const PictureLayer& layer = side.read.layers[0];
    *side.picture = browserPicture(side.bytes, layer, range);
    if (entry.status != done) *side.values = trueValues(layer);
    pictures.thumbnail = thumbnailOf(layer.image);
  }
  if (!record.difference.empty() && entry.status != done && entry.status != unusable)
    pictures.map = readFile(record.difference);
  return pictures;
}

}  // namespace glint
