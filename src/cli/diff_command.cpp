#include <CLI/CLI.hpp>
#include <atomic>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "commands.h"
#include "diff_pair.h"
#include "glint/image/error.h"
#include "glint/image/file.h"

namespace glint {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

double numberOf(const std::string& text, const char* option) {
  double value = 0;
  const char* end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, value);
  if (result.ec != std::errc() || result.ptr != end || std::isnan(value))
    throw InputError(std::string(option) + " '" + printablePath(text) + "': give a number");
  return value;
}

std::vector<double> numbersOf(const std::string& text, const std::string& separators,
                              const char* option, const char* form) {
  std::vector<double> values;
  std::size_t begin = 0;
  for (std::size_t i = 0; i <= separators.size(); ++i) {
    const auto end = i < separators.size() ? text.find(separators[i], begin) : text.size();
    double value = 0;
    const char* last = text.data() + (end == std::string::npos ? begin : end);
    const auto result = std::from_chars(text.data() + std::min(begin, text.size()), last, value);
    if (end == std::string::npos || result.ec != std::errc() || result.ptr != last)
      throw InputError(std::string(option) + " '" + printablePath(text) + "': give " + form);
    values.push_back(value);
    begin = end + 1;
  }
  return values;
}

PixelBox boxOf(const std::string& text) {
  const auto v = numbersOf(text, ",-,", "--ignore", "x1,y1-x2,y2, whole pixels");
  for (const double value : v)
    if (value < 0 || value > 1e6 || value != std::floor(value))
      throw InputError("--ignore '" + printablePath(text) + "': give x1,y1-x2,y2, whole pixels");
  return {int(std::min(v[0], v[2])), int(std::min(v[1], v[3])), int(std::max(v[0], v[2])),
          int(std::max(v[1], v[3]))};
}

std::array<float, 3> colourOf(const std::string& text) {
  if (text.size() == 7 && text[0] == '#') {
    unsigned codes = 0;
    const auto result = std::from_chars(text.data() + 1, text.data() + 7, codes, 16);
    if (result.ec == std::errc() && result.ptr == text.data() + 7) {
      std::array<float, 3> colour{};
      const StoredImage pixel{
          1, 1, 3,
          std::vector<std::uint8_t>{std::uint8_t(codes >> 16), std::uint8_t(codes >> 8),
                                    std::uint8_t(codes)}};
      float rgba[4];
      pixel.linearRows(0, 1, rgba);
      std::copy_n(rgba, 3, colour.begin());
      return colour;
    }
  }
  const auto v = numbersOf(text, ",,", "--alpha over:", "r,g,b in linear light, or #rrggbb");
  return {float(v[0]), float(v[1]), float(v[2])};
}

/// The options as they are given.
struct DiffArguments {
  std::string a, b, json, junit, html, output, difference = "flip", alpha = "straight",
                                               values = "stored", maxPixels, mask, layer, screen;
  std::vector<std::string> metrics, thresholds, ignored, update;
  double tolerance = 0.1, scale = 1, pixelsPerDegree = 0;
  int jobs = 0;
  bool ignoreAntiAliasing = false, updating = false, perDriver = false;
};

DiffSettings settingsOf(const DiffArguments& given) {
  DiffSettings settings;
  CompareOptions& options = settings.compare;
  if (!given.thresholds.empty() && given.thresholds.size() != given.metrics.size())
    throw InputError(std::to_string(given.metrics.size()) + " --metric and " +
                     std::to_string(given.thresholds.size()) +
                     " --threshold: give one threshold for each metric, in their order");
  for (std::size_t i = 0; i < given.metrics.size(); ++i) {
    if (given.thresholds.empty()) {
      options.metrics.push_back(given.metrics[i]);
    } else {
      options.conditions.push_back(
          {given.metrics[i], numberOf(given.thresholds[i], "--threshold")});
    }
  }
  if (!given.maxPixels.empty()) {
    std::string text = given.maxPixels;
    options.maxPixelsIsShare = text.back() == '%';
    if (options.maxPixelsIsShare) text.pop_back();
    options.maxPixels = numberOf(text, "--max-pixels") / (options.maxPixelsIsShare ? 100 : 1);
  }
  const std::string& alpha = given.alpha;
  if (alpha.starts_with("over:")) {
    options.alpha = AlphaUse::over;
    options.background = colourOf(alpha.substr(5));
  } else if (alpha == "ignored") {
    options.alpha = AlphaUse::ignored;
  } else if (alpha != "straight") {
    throw InputError("--alpha '" + printablePath(alpha) +
                     "': give straight, ignored or over:COLOUR");
  }
  if (given.values == "encoded") {
    options.values = ValueSpace::encoded;
  } else if (given.values == "linear") {
    options.values = ValueSpace::linear;
  } else if (given.values != "stored") {
    throw InputError("--values '" + printablePath(given.values) +
                     "': give stored, encoded or linear");
  }
  if (given.difference == "absolute") {
    settings.difference = DifferenceKind::absolute;
  } else if (given.difference == "side-by-side") {
    settings.difference = DifferenceKind::sideBySide;
  } else if (given.difference != "flip") {
    throw InputError("--difference '" + printablePath(given.difference) +
                     "': give flip, absolute or side-by-side");
  }
  for (const std::string& box : given.ignored) options.ignored.push_back(boxOf(box));
  options.tolerance = given.tolerance;
  options.ignoreAntiAliasing = given.ignoreAntiAliasing;
  if (given.pixelsPerDegree != 0) options.flip.pixelsPerDegree = given.pixelsPerDegree;
  if (!given.screen.empty()) {
    const auto v = numbersOf(given.screen, ",,", "--screen", "distance,pixels,width");
    options.flip.pixelsPerDegree = pixelsPerDegree(v[0], v[1], v[2]);
  }
  settings.allMetrics = !given.json.empty() || !given.junit.empty() || !given.html.empty();
  settings.html = !given.html.empty();
  settings.output = given.output;
  settings.scale = given.scale;
  settings.layer = given.layer;
  settings.mask = given.mask;
  return settings;
}

/// The pictures in a folder and its folders, by their paths in it. Driver folders of baselines
/// begin with "driver-".
std::vector<std::string> picturesIn(const std::string& folder, bool baselines) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::recursive_directory_iterator i(folder, error), end; !error && i != end;
       i.increment(error)) {
    std::string ending = i->path().extension().string();
    for (char& letter : ending)
      letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    const fs::path relative = i->path().lexically_relative(folder);
    if (baselines && relative.begin()->string().starts_with("driver-")) continue;
    if (!i->is_regular_file(error)) continue;
    for (const char* known : {".png", ".exr", ".pfm", ".hdr", ".jpg", ".jpeg"})
      if (ending == known) names.push_back(relative.generic_string());
  }
  if (error)
    throw InputError(printablePath(folder) + ": " + error.message() + ": check the folder");
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<DiffEntry> pairsOf(const DiffArguments& given) {
  std::vector<DiffEntry> entries;
  const auto inA = picturesIn(given.a, true), inB = picturesIn(given.b, false);
  std::vector<std::string> all;
  std::set_union(inA.begin(), inA.end(), inB.begin(), inB.end(), std::back_inserter(all));
  for (const std::string& name : all) {
    DiffEntry entry;
    entry.name = name;
    if (std::binary_search(inA.begin(), inA.end(), name)) entry.a = given.a + "/" + name;
    if (std::binary_search(inB.begin(), inB.end(), name)) entry.b = given.b + "/" + name;
    entries.push_back(entry);
  }
  return entries;
}

/// Copies B over the baseline and says so.
void update(const DiffArguments& given, DiffEntry& entry, const std::string& target) {
  const auto& names = given.update;
  const bool named =
      names.empty() || std::find(names.begin(), names.end(), entry.name) != names.end();
  if (!named || entry.b.empty() || entry.status == done || entry.status == unusable) return;
  std::error_code ignored;
  fs::create_directories(fs::path(target).parent_path(), ignored);
  OutputFile file(target);
  file.write(readFile(entry.b));
  file.commit();
  std::cerr << "glint: updated the baseline " << printablePath(target) << "\n";
  entry.status = done;
  entry.note = "baseline updated";
}

int statusOf(const std::vector<DiffEntry>& entries) {
  for (const int status : {int(unusable), int(differs), int(noBaseline)})
    for (const DiffEntry& entry : entries)
      if (entry.status == status) return status;
  return done;
}

int diffFolders(const DiffArguments& given, DiffSettings settings) {
  if (!given.output.empty())
    throw InputError("--output with folders: use --html for the pictures of differences");
  std::vector<DiffEntry> entries = pairsOf(given);
  if (entries.empty())
    throw InputError(printablePath(given.a) + " and " + printablePath(given.b) +
                     ": no pictures in them: give folders of PNG, EXR, PFM, HDR or JPEG files");
  int jobs = given.jobs > 0 ? given.jobs : int(std::thread::hardware_concurrency());
  jobs = std::clamp(jobs, 1, int(std::min<std::size_t>(entries.size(), 64)));
  if (jobs > 1) settings.compare.flip.threads = 1;
  std::vector<PairPictures> pictures(entries.size());
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    for (std::size_t i = next++; i < entries.size(); i = next++) {
      if (given.perDriver) useDriverBaseline(given.a, entries[i]);
      diffPair(settings, entries[i], settings.html ? &pictures[i] : nullptr);
    }
  };
  {
    std::vector<std::jthread> workers;
    for (int i = 1; i < jobs; ++i) workers.emplace_back(work);
    work();
  }
  if (given.updating) {
    for (DiffEntry& entry : entries) {
      std::string target = given.a + "/" + entry.name;
      if (given.perDriver) target = driverBaseline(given.a, entry);
      update(given, entry, target);
    }
    for (const std::string& name : given.update) {
      const auto is = [&](const DiffEntry& entry) { return entry.name == name; };
      if (std::none_of(entries.begin(), entries.end(), is))
        throw InputError("--update '" + printablePath(name) + "': no such pair: check the name");
    }
  }
  std::size_t counts[5] = {};
  Json json{
      {"glint", GLINT_VERSION}, {"a", given.a}, {"b", given.b}, {"status", statusOf(entries)}};
  json["pairs"] = Json::array();
  for (const DiffEntry& entry : entries) {
    ++counts[std::clamp(entry.status, 0, 4)];
    json["pairs"].push_back(diffJson(entry, settings.compare));
    if (entry.status != done && given.json != "-") std::cout << diffLine(entry) << "\n";
  }
  std::size_t extra = 0, missing = 0;
  for (const DiffEntry& entry : entries) {
    missing += entry.b.empty();
    extra += entry.a.empty() && entry.status == noBaseline;
  }
  json["summary"] = {{"pairs", entries.size()}, {"same", counts[0]},
                     {"differ", counts[1]},     {"missing", missing},
                     {"extra", extra},          {"errors", counts[2] - missing}};
  if (given.json != "-")
    std::cout << entries.size() << " pairs: " << counts[0] << " same, " << counts[1] << " differ, "
              << missing << " missing, " << extra << " without baseline, " << counts[2] - missing
              << " unreadable\n";
  if (!given.json.empty()) writeText(given.json, json.dump(2) + "\n");
  if (!given.junit.empty()) writeText(given.junit, junitXml(entries));
  if (!given.html.empty()) writeText(given.html, diffHtml(json, pictures));
  return statusOf(entries);
}

int diff(const DiffArguments& given) {
  DiffSettings settings = settingsOf(given);
  std::error_code ignored;
  const bool folderA = fs::is_directory(given.a, ignored),
             folderB = fs::is_directory(given.b, ignored);
  StoredImage mask;
  if (!given.mask.empty()) {
    mask = readStoredImage(given.mask);
    settings.compare.mask = &mask;
  }
  if (folderA && folderB) return diffFolders(given, settings);
  if (folderB && !fs::exists(given.a, ignored) && given.updating) {
    fs::create_directories(given.a);
    return diffFolders(given, settings);
  }
  if (folderA != folderB && fs::exists(given.a, ignored) && fs::exists(given.b, ignored))
    throw InputError(printablePath(given.a) + " and " + printablePath(given.b) +
                     ": one is a folder, the other a file: give two of a kind");
  std::vector<DiffEntry> entries(1);
  DiffEntry& entry = entries[0];
  entry.name = fs::path(given.b).filename().string();
  if (fs::exists(given.a, ignored)) entry.a = given.a;
  if (fs::exists(given.b, ignored)) entry.b = given.b;
  PairPictures pictures;
  diffPair(settings, entry, settings.html ? &pictures : nullptr);
  if (entry.a.empty() && !entry.b.empty())
    entry.error = printablePath(given.a) + ": no baseline: look at " + printablePath(given.b) +
                  " and accept it with --update";
  if (entry.b.empty()) entry.error = printablePath(given.b) + ": No such file: check the path";
  if (given.updating) update(given, entry, given.a);
  const Json json = [&] {
    Json made = diffJson(entry, settings.compare);
    made["glint"] = GLINT_VERSION;
    return made;
  }();
  if (entry.status != done && !entry.error.empty()) {
    std::cerr << "glint: " << entry.error << "\n";
  } else if (given.json != "-") {
    std::cout << diffLine(entry) << "\n";
  }
  if (!given.json.empty()) writeText(given.json, json.dump(2) + "\n");
  if (!given.junit.empty()) writeText(given.junit, junitXml(entries));
  if (!given.html.empty())
    writeText(given.html, diffHtml({{"a", given.a}, {"b", given.b}, {"pairs", Json::array({json})}},
                                   {pictures}));
  return entry.status;
}

}  // namespace

Command addDiff(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("diff", "compare two pictures, or two folders of them, with baselines");
  auto given = std::make_shared<DiffArguments>();
  const auto text = [&](const char* name, std::string& value, const char* type, const char* help) {
    return command->add_option(name, value, help)->type_name(type)->take_last();
  };
  command->add_option("A", given->a, "the baseline: PNG, EXR, PFM, HDR, JPEG, or a folder")
      ->required();
  command->add_option("B", given->b, "the picture or folder to be checked")->required();
  command
      ->add_option("--metric", given->metrics,
                   "max, mean, rmse, relative-rmse, psnr, pixels, ssim, flip or hdr-flip; "
                   "repeatable; without a threshold it is only told")
      ->type_name("NAME")
      ->allow_extra_args(false);
  command
      ->add_option("--threshold", given->thresholds,
                   "of the metric before it: the largest value allowed, of psnr and ssim the "
                   "smallest; without any condition the pictures must be equal")
      ->type_name("T")
      ->allow_extra_args(false);
  text("--max-pixels", given->maxPixels, "N|P%", "so many pixels may be over the tolerance");
  command
      ->add_option("--tolerance", given->tolerance,
                   "of a pixel, 0 to 1: distance in YIQ, as pixelmatch's threshold [default: 0.1]")
      ->type_name("T")
      ->check(CLI::Range(0.0, 1.0));
  command->add_flag("--ignore-anti-aliasing", given->ignoreAntiAliasing,
                    "do not count pixels that look anti-aliased");
  command
      ->add_option("--ignore", given->ignored,
                   "leave out a rectangle, corners included; repeatable")
      ->type_name("x1,y1-x2,y2")
      ->allow_extra_args(false);
  text("--mask", given->mask, "FILE", "leave out what is black in this picture");
  text("--alpha", given->alpha, "straight|ignored|over:COLOUR",
       "alpha as a fourth value, not at all, or both pictures over a colour [default: straight]");
  text("--values", given->values, "stored|encoded|linear",
       "compare sRGB values or linear light; stored: as in the files, which must agree "
       "[default: stored]");
  text("--layer", given->layer, "NAME", "of EXR files: compare this layer");
  command->add_option("--pixels-per-degree", given->pixelsPerDegree, "for FLIP [default: 67.0206]")
      ->type_name("P")
      ->check(CLI::Range(1e-3, 1000.0));
  text("--screen", given->screen, "distance,pixels,width",
       "for FLIP instead: metres to the screen, pixels across, metres across");
  text("-o,--output", given->output, "FILE", "write a picture of the differences");
  text("--difference", given->difference, "flip|absolute|side-by-side",
       "what it shows: FLIP's map, |a - b|, or a, b and |a - b| [default: flip]");
  command->add_option("--scale", given->scale, "of |a - b| in that picture [default: 1]")
      ->type_name("K");
  text("--json", given->json, "FILE", "write all metrics as JSON; - is stdout");
  text("--junit", given->junit, "FILE", "write the results for a CI server");
  text("--html", given->html, "FILE", "write a report to look at, in one file");
  command->add_option("--jobs", given->jobs, "pairs at a time [default: as many as processors]")
      ->type_name("N")
      ->check(CLI::Range(1, 256));
  CLI::Option* updating =
      command
          ->add_option("--update", given->update,
                       "make B the baseline where it differs or there is none: of all pairs, or "
                       "of these; says so for each")
          ->type_name("[NAME...]")
          ->expected(0, 1 << 20);
  command->add_flag("--baselines-per-driver", given->perDriver,
                    "prefer A/driver-NAME/..., NAME made from the GL_RENDERER that B's files tell");
  return [given, updating] {
    given->updating = updating->count() > 0;
    std::erase(given->update, "");
    return diff(*given);
  };
}

}  // namespace glint
