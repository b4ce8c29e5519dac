#include "diff_options.h"

#include <fnmatch.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <sstream>

#include "glint/image/error.h"
#include "glint/image/file.h"
#include "glint/options/add_option.h"

namespace glint {
namespace {

double numberOf(const std::string& text, const char* option) {
  double value = 0;
  const char* end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, value);
  if (result.ec != std::errc() || result.ptr != end || std::isnan(value))
    throw InputError(std::string(option) + " '" + printablePath(text) + "': give a number");
  return value;
}

// Numbers that are 0 or more.
std::vector<double> numbersOf(const std::string& text, const std::string& separators,
                              const char* option, const char* form) {
  std::vector<double> values;
  std::size_t begin = 0;
  for (std::size_t i = 0; i <= separators.size(); ++i) {
    const auto end = i < separators.size() ? text.find(separators[i], begin) : text.size();
    double value = 0;
    const char* last = text.data() + (end == std::string::npos ? begin : end);
    const auto result = std::from_chars(text.data() + std::min(begin, text.size()), last, value);
    if (end == std::string::npos || result.ec != std::errc() || result.ptr != last || !(value >= 0))
      throw InputError(std::string(option) + " '" + printablePath(text) + "': give " + form);
    values.push_back(value);
    begin = end + 1;
  }
  return values;
}

PixelBox boxOf(const std::string& text) {
  const auto v = numbersOf(text, ",-,", "--ignore", "x1,y1-x2,y2, whole pixels");
  for (const double value : v)
    if (value > 1e6 || value != std::floor(value))
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
  const char* form = "r,g,b in linear light, 0 to 1e6, or #rrggbb";
  const auto v = numbersOf(text, ",,", "--alpha over:", form);
  if (std::ranges::max(v) > 1e6)
    throw InputError("--alpha over: '" + printablePath(text) + "': give " + form);
  return {float(v[0]), float(v[1]), float(v[2])};
}

}  // namespace

int choiceOf(const std::string& text, std::initializer_list<std::string_view> words,
             const char* option) {
  const auto found = std::ranges::find(words, text);
  if (found != words.end()) return int(found - words.begin());
  std::string all;
  for (const auto* word = words.begin(); word != words.end(); ++word)
    all += (word == words.begin()     ? ""
            : word + 1 == words.end() ? " or "
                                      : ", ") +
           std::string(*word);
  throw InputError(std::string(option) + " '" + printablePath(text) + "': give " + all);
}

void addComparisonOptions(CLI::App& command, ComparisonArguments& given) {
  const auto text = [&](const char* name, std::string& value, const char* type, const char* help) {
    return addOption(command, name, value, type, help)->take_last();
  };
  std::string names, similarities;
  for (const std::string& name : metricNames()) {
    names += name + (name == metricNames().back() ? "" : ", ");
    if (isSimilarity(name)) similarities += (similarities.empty() ? "" : ", ") + name;
  }
  given.metric = addOption(command, "--metric", given.metricNames, "NAME",
                           "metric to compute: " + names +
                               "; repeatable; without a threshold it is only reported")
                     ->allow_extra_args(false);
  given.threshold =
      addOption(command, "--threshold", given.thresholds, "T",
                "limit of the metric before it: the largest value that passes (" + similarities +
                    ": the smallest); without any limit the pictures must be identical")
          ->allow_extra_args(false);
  addOption(command, "--max-pixels", given.maxPixels, "N|P%",
            "how many pixels may exceed the tolerance; repeatable: all limits must hold")
      ->allow_extra_args(false);
  addNumber(command, "--tolerance", given.tolerance, "T", 0.0, 1.0,
            "largest colour distance at which a pixel counts as the same (0 to 1, like "
            "pixelmatch's threshold) [default: 0.1]");
  text("--pixelmatch", given.pixelmatch, "7|8",
       "version of pixelmatch whose distance is used: 7 is in YIQ, 8 is HyAB in OKLab "
       "[default: 7]");
  addNumber(command, "--shift", given.shift, "N", 0, 16,
            "do not count pixels that occur in the other picture within N pixels");
  addNumber(command, "--window", given.window, "N", 1, 1 << 20,
            "count in the worst window of N x N pixels instead of in the whole picture");
  command.add_flag("--ignore-anti-aliasing", given.ignoreAntiAliasing,
                   "do not count pixels that look anti-aliased");
  addOption(command, "--ignore", given.ignored, "x1,y1-x2,y2",
            "ignore a rectangle, corners included; repeatable")
      ->allow_extra_args(false);
  text("--mask", given.mask, "FILE", "ignore the pixels that are black in this picture");
  text("--alpha", given.alpha, "straight|ignored|over:COLOUR",
       "compare alpha as a fourth value, ignore it, or put both pictures over a colour "
       "[default: straight]");
  text("--values", given.values, "stored|encoded|linear",
       "compare sRGB values or linear light; stored: as in the files, which must be of the same "
       "kind [default: stored]");
  text("--layer", given.layer, "NAME|main|all",
       "part of EXR files to compare: a layer, channel or part by name, the main picture, or all "
       "[default: all]");
  addNumber(command, "--pixels-per-degree", given.pixelsPerDegree, "P", 1e-3, 1000.0,
            "viewing condition for FLIP [default: 67.0206]");
  text("--screen", given.screen, "distance,pixels,width",
       "viewing condition for FLIP, instead: distance to the screen in metres, its width in "
       "pixels and in metres");
  text("--start-exposure", given.startExposure, "EV",
       "first exposure of HDR-FLIP [default: from the baseline]");
  text("--stop-exposure", given.stopExposure, "EV",
       "last exposure of HDR-FLIP [default: from the baseline]");
  addNumber(command, "--exposures", given.exposures, "N", 1, 64,
            "number of exposures of HDR-FLIP [default: one a stop]");
  text("--tone-mapper", given.toneMapper, "aces|hable|reinhard",
       "tone mapper of HDR-FLIP [default: aces]");
}

DiffSettings comparisonSettings(const CLI::App& command, const ComparisonArguments& given,
                                const std::string& folder) {
  // --metric NAME and --threshold T in the order given; the name of a threshold is empty.
  std::vector<std::pair<std::string, std::string>> ordered;
  std::size_t nextMetric = 0, nextThreshold = 0;
  for (const CLI::Option* option : command.parse_order()) {
    if (option == given.metric) ordered.emplace_back(given.metricNames[nextMetric++], "");
    if (option == given.threshold) ordered.emplace_back("", given.thresholds[nextThreshold++]);
  }
  DiffSettings settings;
  CompareOptions& options = settings.compare;
  for (std::size_t i = 0; i < ordered.size(); ++i) {
    const auto& [name, none] = ordered[i];
    if (name.empty())
      throw InputError("--threshold " + printablePath(none) + ": give the metric before it");
    const bool bounded = i + 1 < ordered.size() && ordered[i + 1].first.empty();
    if (!bounded) {
      options.metrics.push_back(name);
      continue;
    }
    ++i;
    const double limit = numberOf(ordered[i].second, "--threshold");
    if (limit < 0 && !isSimilarity(name))  // a similarity may be negative, a difference not
      throw InputError("--threshold '" + printablePath(ordered[i].second) +
                       "': give 0 or more for " + name);
    options.conditions.push_back({name, limit});
  }
  for (std::string text : given.maxPixels) {
    const std::string asGiven = text;
    const bool isShare = !text.empty() && text.back() == '%';
    if (isShare) text.pop_back();
    const double number = numberOf(text, "--max-pixels");
    if (number < 0 || (isShare && number > 100))
      throw InputError("--max-pixels " + printablePath(asGiven) +
                       ": give a number of pixels, or 0% to 100%");
    options.maxPixels.push_back({number / (isShare ? 100 : 1), isShare});
  }
  const std::string& alpha = given.alpha;
  if (alpha.starts_with("over:")) {
    options.alpha = AlphaUse::over;
    options.background = colourOf(alpha.substr(5));
  } else if (choiceOf(alpha, {"straight", "ignored", "over:COLOUR"}, "--alpha") == 1) {
    options.alpha = AlphaUse::ignored;
  }
  options.values = ValueSpace(choiceOf(given.values, {"stored", "encoded", "linear"}, "--values"));
  options.distance = PixelDistance(choiceOf(given.pixelmatch, {"7", "8"}, "--pixelmatch"));
  options.flip.toneMapper =
      ToneMapper(choiceOf(given.toneMapper, {"aces", "hable", "reinhard"}, "--tone-mapper"));
  const auto exposure = [](const std::string& text, const char* option) {
    std::optional<double> value;
    if (!text.empty()) value = numberOf(text, option);
    if (value && std::fabs(*value) > 100)
      throw InputError(std::string(option) + " '" + printablePath(text) +
                       "': give -100 to 100 stops");
    return value;
  };
  options.flip.startExposure = exposure(given.startExposure, "--start-exposure");
  options.flip.stopExposure = exposure(given.stopExposure, "--stop-exposure");
  options.flip.exposures = given.exposures;
  options.shift = given.shift;
  options.window = given.window;
  const bool counts = !options.maxPixels.empty() ||
                      std::count(given.metricNames.begin(), given.metricNames.end(), "pixels") > 0;
  for (const auto& [name, used] : {std::pair{"--shift", given.shift > 0},
                                   {"--window", given.window > 0},
                                   {"--ignore-anti-aliasing", given.ignoreAntiAliasing}})
    if (used && !counts)
      throw InputError(std::string(name) +
                       ": it modifies --max-pixels: give that, too (--max-pixels 0)");
  for (const std::string& box : given.ignored) options.ignored.push_back(boxOf(box));
  options.tolerance = given.tolerance;
  options.ignoreAntiAliasing = given.ignoreAntiAliasing;
  if (given.pixelsPerDegree != 0) options.flip.pixelsPerDegree = given.pixelsPerDegree;
  if (!given.screen.empty()) {
    const auto v = numbersOf(given.screen, ",,", "--screen", "distance,pixels,width");
    options.flip.pixelsPerDegree = pixelsPerDegree(v[0], v[1], v[2]);
  }
  settings.layer = given.layer;
  if (!given.mask.empty()) {
    const bool inFolder = !folder.empty() && given.mask[0] != '/';
    settings.maskPath = inFolder ? folder + "/" + given.mask : given.mask;
    settings.mask = std::make_shared<const StoredImage>(readStoredImage(settings.maskPath));
    options.mask = settings.mask.get();
  }
  return settings;
}

std::vector<PairConditions> readConditions(const std::string& path) {
  const std::vector<std::byte> bytes = readFile(path);
  std::istringstream lines(std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
  const std::string folder = std::filesystem::path(path).parent_path().string();
  std::vector<PairConditions> conditions;
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    std::vector<std::string> words = CLI::detail::split_up(line);
    std::erase(words, "");
    if (words.empty() || words[0].starts_with('#')) continue;
    CLI::App app;
    app.set_help_flag();
    ComparisonArguments given;
    addComparisonOptions(app, given);
    const std::string where = printablePath(path) + ":" + std::to_string(number) + ": ";
    try {
      // The parser expects the words in reverse order.
      app.parse(std::vector<std::string>(words.rbegin(), words.rend() - 1));
      conditions.push_back(
          {words[0], comparisonSettings(app, given, folder.empty() ? "." : folder), where});
    } catch (const CLI::Error& error) {
      throw InputError(where + error.what() +
                       ": give a pattern of names and options of glint diff");
    } catch (const InputError& error) {
      throw InputError(where + error.what());
    }
  }
  return conditions;
}

bool isNamedBy(const std::string& pattern, const std::string& name) {
  const std::string folder = pattern.ends_with('/') ? pattern : pattern + "/";
  return pattern == name || name.starts_with(folder) ||
         ::fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
}

}  // namespace glint
