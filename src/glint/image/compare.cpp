#include "glint/image/compare.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>

#include "glint/image/compared_rows.h"
#include "glint/image/error.h"

namespace glint {
namespace {

/// The differences of single pixels, summed up row by row.
class Sums {
 public:
  Sums(const detail::ComparedRows& rows, std::size_t worst, Comparison& result)
      : rows_(rows), worst_(worst), result_(result) {}

  void run() {
    const int width = rows_.width();
    std::vector<float> a(std::size_t(4) * width), b(a.size());
    std::vector<unsigned char> counts(std::size_t(width), 1);
    for (int y = 0; y < rows_.height(); ++y) {
      rows_.values(y, a.data(), b.data());
      if (rows_.ignoresSome()) rows_.counted(y, counts.data());
      Row row;
      for (int x = 0; x < width; ++x) {
        if (counts[std::size_t(x)]) {
          add(x, y, &a[std::size_t(4) * x], &b[std::size_t(4) * x], row);
        } else {
          ++result_.ignoredPixels;
        }
      }
      absolute_ += row.absolute;
      square_ += row.square;
      relative_ += row.relative;
    }
    finish();
  }

 private:
  struct Row {
    double absolute = 0, square = 0, relative = 0;
  };

  void add(int x, int y, const float* a, const float* b, Row& row) {
    const std::size_t channels = std::size_t(rows_.channels());
    ++result_.pixels;
    // The same values, which most pixels have, need no more than to be finite.
    float sum = 0;
    bool equal = true;
    for (std::size_t c = 0; c < channels; ++c) {
      sum += a[c] * 0 + b[c] * 0;
      equal = equal && a[c] == b[c];
    }
    if (sum == 0 && equal) {
      finite_ += channels;
      return;
    }
    addDifferent(x, y, a, b, row);
  }

  void addDifferent(int x, int y, const float* a, const float* b, Row& row) {
    const std::size_t channels = std::size_t(rows_.channels());
    bool nanA = false, nanB = false, infinityA = false, infinityB = false, differs = false;
    double largest = 0;
    for (std::size_t c = 0; c < channels; ++c) {
      nanA = nanA || std::isnan(a[c]);
      nanB = nanB || std::isnan(b[c]);
      infinityA = infinityA || std::isinf(a[c]);
      infinityB = infinityB || std::isinf(b[c]);
      differs = differs || !(a[c] == b[c] || (std::isnan(a[c]) && std::isnan(b[c])));
      const double difference = std::fabs(double(a[c]) - double(b[c]));
      if (!std::isfinite(difference)) continue;
      ++finite_;
      largest = std::max(largest, difference);
      row.absolute += difference;
      row.square += difference * difference;
      row.relative += difference * difference / (double(a[c]) * a[c] + 0.01);
    }
    if (channels == 4 && a[3] != b[3]) addSeenThrough(a, b);
    result_.nanA += nanA;
    result_.nanB += nanB;
    result_.infinityA += infinityA;
    result_.infinityB += infinityB;
    result_.differing += differs;
    maximum_ = std::max(maximum_, largest);
    if (!differs) return;
    // Not finite is worse than every number.
    const bool finite = !(nanA || nanB || infinityA || infinityB);
    keep({x,
          y,
          {a[0], a[1], a[2], a[3]},
          {b[0], b[1], b[2], b[3]},
          finite ? largest : std::numeric_limits<double>::infinity()});
  }

  /// How much of a difference shows over black and over white.
  void addSeenThrough(const float* a, const float* b) {
    ++result_.alphaDiffering;
    for (std::size_t c = 0; c < 3; ++c) {
      const double black = double(a[c]) * a[3] - double(b[c]) * b[3];
      const double white = black - (double(a[3]) - double(b[3]));
      if (!std::isfinite(black)) continue;
      overBlack_ += black * black;
      overWhite_ += white * white;
    }
  }

  /// Keeps the worst pixels; of equal ones the first.
  void keep(const WorstPixel& pixel) {
    auto& worst = result_.worst;
    if (worst.size() == worst_ && (worst.empty() || worst.back().difference >= pixel.difference))
      return;
    const auto place =
        std::upper_bound(worst.begin(), worst.end(), pixel,
                         [](const auto& l, const auto& r) { return l.difference > r.difference; });
    worst.insert(place, pixel);
    if (worst.size() > worst_) worst.pop_back();
  }

  void finish() {
    result_.seenOverWhite = overWhite_ > overBlack_;
    const double count = finite_ > 0 ? double(finite_) : 1;
    const double rmse = std::sqrt(square_ / count);
    result_.values["max"] = maximum_;
    result_.values["mean"] = absolute_ / count;
    result_.values["rmse"] = rmse;
    result_.values["relative-rmse"] = std::sqrt(relative_ / count);
    result_.values["psnr"] =
        rmse > 0 ? -20 * std::log10(rmse) : std::numeric_limits<double>::infinity();
  }

  const detail::ComparedRows& rows_;
  std::size_t worst_;
  Comparison& result_;
  double absolute_ = 0, square_ = 0, relative_ = 0, maximum_ = 0;
  double overBlack_ = 0, overWhite_ = 0;
  std::size_t finite_ = 0;
};

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

void judge(const CompareOptions& options, Comparison& result) {
  const bool equality = options.conditions.empty() && !options.maxPixels;
  if (equality && result.differing > 0)
    result.failures.push_back(std::to_string(result.differing) + " pixels differ");
  for (const auto& [name, threshold] : options.conditions) {
    const double value = result.values.at(name);
    // Written so that a NaN fails.
    if (isSimilarity(name) ? value >= threshold : value <= threshold) continue;
    result.failures.push_back(name + " " + number(value) +
                              (isSimilarity(name) ? " is below " : " is above ") +
                              number(threshold));
  }
  if (options.maxPixels) {
    const double over = result.values.at("pixels");
    const double allowed =
        options.maxPixelsIsShare ? *options.maxPixels * double(result.pixels) : *options.maxPixels;
    if (!(over <= allowed))
      result.failures.push_back(number(over) + " pixels are over the tolerance of " +
                                number(options.tolerance) + ", allowed are " + number(allowed));
  }
  const auto refuse = [&](std::size_t count, const char* what) {
    if (!equality && count > 0)
      result.failures.push_back(std::to_string(count) + " pixels " + what);
  };
  refuse(result.nanA, "of the baseline are not numbers");
  refuse(result.nanB, "are not numbers");
  refuse(result.infinityA, "of the baseline are infinite");
  refuse(result.infinityB, "are infinite");
  if (result.pixels == 0) result.failures.push_back("no pixel is left to compare");
  result.same = result.failures.empty();
}

}  // namespace

const std::vector<std::string>& metricNames() {
  static const std::vector<std::string> names{"max",    "mean", "rmse", "relative-rmse", "psnr",
                                              "pixels", "ssim", "flip", "hdr-flip"};
  return names;
}

bool isSimilarity(const std::string& metric) { return metric == "psnr" || metric == "ssim"; }

Comparison compare(const StoredImage& a, const StoredImage& b, const CompareOptions& options) {
  std::vector<std::string> wanted = options.metrics;
  for (const Condition& condition : options.conditions) wanted.push_back(condition.metric);
  if (options.maxPixels) wanted.push_back("pixels");
  const auto asked = [&](const char* name) {
    return std::find(wanted.begin(), wanted.end(), name) != wanted.end();
  };
  for (const std::string& name : wanted) {
    const auto& names = metricNames();
    if (std::find(names.begin(), names.end(), name) != names.end()) continue;
    std::string all;
    for (const std::string& known : names) all += (all.empty() ? "" : ", ") + known;
    throw InputError("unknown metric '" + name + "': give one of " + all);
  }
  Comparison result;
  if (a.width != b.width || a.height != b.height) {
    result.failures.push_back(detail::sizesText(a, b));
    return result;
  }
  detail::ComparedRows rows(a, b, options);
  result.space = rows.space();
  Sums(rows, options.worst, result).run();
  if (asked("pixels")) {
    std::vector<const detail::ComparedRows*> views{&rows};
    detail::ComparedRows white = rows;
    white.showOver({1, 1, 1});
    if (result.alphaDiffering > 0) views.push_back(&white);
    const auto count = detail::countPixels(views, options.tolerance, options.ignoreAntiAliasing);
    result.values["pixels"] = double(count.over);
    result.antiAliased = count.antiAliased;
  }
  if (result.seenOverWhite) rows.showOver({1, 1, 1});
  if (asked("ssim")) result.values["ssim"] = detail::structuralSimilarity(rows);
  std::function<void(int, unsigned char*)> counts;
  if (rows.ignoresSome()) counts = [&](int y, unsigned char* row) { rows.counted(y, row); };
  if (asked("flip")) {
    result.flip = flip(rows.linearA(), rows.linearB(), options.flip,
                       asked("hdr-flip") ? FlipRows() : options.flipMap, counts);
    result.values["flip"] = result.flip.mean;
  }
  if (asked("hdr-flip")) {
    result.hdrFlip = hdrFlip(rows.linearA(), rows.linearB(), options.flip, options.flipMap, counts);
    result.values["hdr-flip"] = result.hdrFlip.mean;
  }
  judge(options, result);
  return result;
}

Comparison compare(const Image& a, const Image& b, const CompareOptions& options) {
  const auto stored = [](const Image& image) {
    return StoredImage{image.width, image.height, 4, image.values};
  };
  return compare(stored(a), stored(b), options);
}

std::string Comparison::worstText() const {
  std::string text;
  for (const WorstPixel& pixel : worst) {
    text += "(" + std::to_string(pixel.x) + ", " + std::to_string(pixel.y) + "): ";
    for (const auto* of : {&pixel.a, &pixel.b}) {
      for (std::size_t c = 0; c < 4; ++c) text += (c == 0 ? "" : " ") + number((*of)[c]);
      text += of == &pixel.a ? " -> " : "";
    }
    text += ", difference " + number(pixel.difference) + "\n";
  }
  return text;
}

}  // namespace glint
