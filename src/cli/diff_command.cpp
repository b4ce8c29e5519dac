#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <memory>

#include "commands.h"
#include "diff_run.h"
#include "glint/image/error.h"
#include "glint/image/file.h"
#include "glint/options/help.h"

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
  /// --metric NAME and --threshold T as they stand one after the other, the latter's name empty.
  std::vector<std::pair<std::string, std::string>> metrics;
  std::vector<std::string> metricNames, thresholds, ignored, update;
  double tolerance = 0.1, scale = 1, pixelsPerDegree = 0;
  int jobs = 0;
  bool ignoreAntiAliasing = false, updating = false, perDriver = false;
};

DiffSettings settingsOf(const DiffArguments& given) {
  DiffSettings settings;
  CompareOptions& options = settings.compare;
  for (std::size_t i = 0; i < given.metrics.size(); ++i) {
    const auto& [name, none] = given.metrics[i];
    if (name.empty())
      throw InputError("--threshold " + printablePath(none) + ": give the metric before it");
    const bool bounded = i + 1 < given.metrics.size() && given.metrics[i + 1].first.empty();
    if (!bounded) {
      options.metrics.push_back(name);
      continue;
    }
    ++i;
    options.conditions.push_back({name, numberOf(given.metrics[i].second, "--threshold")});
  }
  if (!given.maxPixels.empty()) {
    std::string text = given.maxPixels;
    options.maxPixelsIsShare = text.back() == '%';
    if (options.maxPixelsIsShare) text.pop_back();
    const double number = numberOf(text, "--max-pixels");
    if (number < 0 || (options.maxPixelsIsShare && number > 100))
      throw InputError("--max-pixels " + printablePath(given.maxPixels) +
                       ": give a number of pixels, or 0% to 100%");
    options.maxPixels = number / (options.maxPixelsIsShare ? 100 : 1);
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
  return settings;
}

/// --update takes all names that follow it, so that A and B behind it are its last two.
void takePathsBack(DiffArguments& given) {
  for (std::string* path : {&given.b, &given.a}) {
    if (!path->empty() || given.update.empty()) continue;
    *path = given.update.back();
    given.update.pop_back();
  }
  if (given.a.empty() || given.b.empty())
    throw InputError("diff: give two pictures, or two folders: glint diff A B");
}

int diff(DiffArguments given) {
  takePathsBack(given);
  DiffRequest request;
  request.settings = settingsOf(given);
  request.a = given.a;
  request.b = given.b;
  request.json = given.json;
  request.junit = given.junit;
  request.html = given.html;
  request.mask = given.mask;
  request.updating = given.updating;
  request.named = given.update;
  request.perDriver = given.perDriver;
  request.jobs = given.jobs;
  return runDiff(std::move(request));
}

}  // namespace

Command addDiff(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("diff", "compare two pictures, or two folders of them, with baselines");
  command->footer(examples({"diff a.png b.png",
                            "diff a.png b.png --metric flip --threshold 0.05 -o difference.png",
                            "diff a.png b.png --max-pixels 0.1% --ignore-anti-aliasing",
                            "diff baselines pictures --html report.html --junit report.xml",
                            "diff baselines pictures --update"}));
  auto given = std::make_shared<DiffArguments>();
  const auto text = [&](const char* name, std::string& value, const char* type, const char* help) {
    return command->add_option(name, value, help)->type_name(type)->take_last();
  };
  command->add_option("A", given->a,
                      "the baseline: a PNG, EXR, PFM, HDR or JPEG file, or a folder of them");
  command->add_option("B", given->b, "the picture or folder to check");
  CLI::Option* metric =
      command
          ->add_option("--metric", given->metricNames,
                       "max, mean, rmse, relative-rmse, psnr, pixels, ssim, flip or hdr-flip; "
                       "repeatable; without a threshold it is only reported")
          ->type_name("NAME")
          ->allow_extra_args(false);
  CLI::Option* threshold =
      command
          ->add_option(
              "--threshold", given->thresholds,
              "limit of the metric before it: the largest value that passes (psnr, ssim: the "
              "smallest); without any limit the pictures must be identical")
          ->type_name("T")
          ->allow_extra_args(false);
  text("--max-pixels", given->maxPixels, "N|P%", "how many pixels may be over the tolerance");
  command
      ->add_option("--tolerance", given->tolerance,
                   "of a pixel, 0 to 1: distance in YIQ, the same as pixelmatch's threshold "
                   "[default: 0.1]")
      ->type_name("T")
      ->check(CLI::Range(0.0, 1.0).description(""));
  command->add_flag("--ignore-anti-aliasing", given->ignoreAntiAliasing,
                    "do not count pixels that look anti-aliased");
  command
      ->add_option("--ignore", given->ignored, "ignore a rectangle, corners included; repeatable")
      ->type_name("x1,y1-x2,y2")
      ->allow_extra_args(false);
  text("--mask", given->mask, "FILE", "ignore the pixels that are black in this picture");
  text("--alpha", given->alpha, "straight|ignored|over:COLOUR",
       "compare alpha as a fourth value, ignore it, or put both pictures over a colour "
       "[default: straight]");
  text("--values", given->values, "stored|encoded|linear",
       "compare sRGB values or linear light; stored: as in the files, which must be of one kind "
       "[default: stored]");
  text("--layer", given->layer, "NAME", "the layer of EXR files to compare");
  command
      ->add_option("--pixels-per-degree", given->pixelsPerDegree,
                   "viewing condition of FLIP [default: 67.0206]")
      ->type_name("P")
      ->check(CLI::Range(1e-3, 1000.0).description(""));
  text("--screen", given->screen, "distance,pixels,width",
       "viewing condition of FLIP by metres to the screen, its width in pixels, and in metres");
  text("-o,--output", given->output, "FILE", "write a picture of the differences");
  text("--difference", given->difference, "flip|absolute|side-by-side",
       "content of that picture: the FLIP map, |a - b|, or a, b and |a - b| [default: flip]");
  command->add_option("--scale", given->scale, "factor of |a - b| in that picture [default: 1]")
      ->type_name("K")
      ->check(CLI::Range(0.0, 1e6).description(""));
  text("--json", given->json, "FILE", "write all metrics as JSON; - is stdout");
  text("--junit", given->junit, "FILE", "write the results as JUnit XML, for a CI server");
  text("--html", given->html, "FILE", "write a report as one HTML file");
  command
      ->add_option("--jobs", given->jobs,
                   "number of pairs compared at the same time [default: the number of processors]")
      ->type_name("N")
      ->check(CLI::Range(1, 256).description(""));
  CLI::Option* updating =
      command
          ->add_option(
              "--update", given->update,
              "replace or create the baseline where B differs or none exists, of all pairs or "
              "of these; lists what it wrote")
          ->type_name("[NAME...]")
          ->expected(0, 1 << 20);
  command->add_flag(
      "--baselines-per-driver", given->perDriver,
      "prefer baselines in a folder driver-NAME of A (of a file: beside it), NAME made "
      "from the GL_RENDERER recorded in B");
  return [=] {
    std::size_t metrics = 0, thresholds = 0;
    for (const CLI::Option* option : command->parse_order()) {
      if (option == metric) given->metrics.emplace_back(given->metricNames[metrics++], "");
      if (option == threshold) given->metrics.emplace_back("", given->thresholds[thresholds++]);
    }
    given->updating = updating->count() > 0;
    std::erase(given->update, "");
    return diff(*given);
  };
}

}  // namespace glint
