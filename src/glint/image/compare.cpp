#include "glint/image/compare.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <type_traits>

#include "glint/image/compared_rows.h"
#include "glint/image/error.h"
#include "glint/image/metrics.h"
#include "glint/image/regions.h"
#include "glint/image/row_window.h"

namespace glint {
namespace {

/// Sums up the differences of individual pixels, row by row.
class Sums {
 public:
  Sums(const detail::ComparedRows& rows, const CompareOptions& options, Comparison& result)
      : rows_(rows), worst_(options.worst), result_(result) {
    if (options.regions) regions_.emplace(rows.width(), rows.height());
  }

  void run() {
    const int width = rows_.width();
    std::vector<float> a(std::size_t(4) * width), b(a.size());
    std::vector<unsigned char> counts(std::size_t(width), 1);
    for (int y = 0; y < rows_.height(); ++y) {
      if (!rows_.ignoresSome() && rows_.codesAreEqual(y)) {
        result_.pixels += std::size_t(width);
        sums_.count += std::size_t(width) * std::size_t(rows_.channels());
        continue;
      }
      if (rows_.ignoresSome()) rows_.counted(y, counts.data());
      Row row;
      if (rows_.comparesCodes()) {
        addCodes(y, counts, row);
      } else {
        rows_.values(y, a.data(), b.data());
        for (int x = 0; x < width; ++x)
          if (counts[std::size_t(x)])
            add(x, y, &a[std::size_t(4) * x], &b[std::size_t(4) * x], row);
      }
      if (rows_.ignoresSome())
        result_.ignoredPixels += std::size_t(std::count(counts.begin(), counts.end(), 0));
      sums_.absolute += row.absolute;
      sums_.square += row.square;
      sums_.relative += row.relative;
    }
    finish();
  }

 private:
  struct Row {
    double absolute = 0, square = 0, relative = 0;
  };

  /// A row of 8-bit codes: only the pixels that differ become floats.
  void addCodes(int y, const std::vector<unsigned char>& counts, Row& row) {
    const int width = rows_.width();
    const std::uint8_t *a = rows_.codesA(y, codesA_), *b = rows_.codesB(y, codesB_);
    const std::size_t step = std::size_t(rows_.codeChannels());
    const auto channels = std::size_t(rows_.channels());
    std::size_t same = 0, counted = 0;
    for (int x = 0; x < width; ++x, a += step, b += step) {
      if (!counts[std::size_t(x)]) continue;
      ++counted;
      if (a[0] == b[0] && a[1] == b[1] && a[2] == b[2] && (step == 3 || a[3] == b[3])) {
        ++same;
        continue;
      }
      float va[4], vb[4];
      rows_.valuesOf(a, va);
      rows_.valuesOf(b, vb);
      addDifferent(x, y, va, vb, row);
    }
    result_.pixels += counted;
    sums_.count += same * channels;
  }

  void add(int x, int y, const float* a, const float* b, Row& row) {
    const std::size_t channels = std::size_t(rows_.channels());
    ++result_.pixels;
    // Equal values, which most pixels have, only need to be finite.
    float sum = 0;
    bool equal = true;
    for (std::size_t c = 0; c < channels; ++c) {
      sum += a[c] * 0 + b[c] * 0;
      equal = equal && a[c] == b[c];
    }
    if (sum == 0 && equal) {
      sums_.count += channels;
      return;
    }
    addDifferent(x, y, a, b, row);
  }

  void addDifferent(int x, int y, const float* a, const float* b, Row& row) {
    const std::size_t channels = std::size_t(rows_.channels());
    bool nanA = false, nanB = false, infinityA = false, infinityB = false, differs = false,
         infinityDiffers = false;
    double largest = 0;
    for (std::size_t c = 0; c < channels; ++c) {
      nanA = nanA || std::isnan(a[c]);
      nanB = nanB || std::isnan(b[c]);
      infinityA = infinityA || std::isinf(a[c]);
      infinityB = infinityB || std::isinf(b[c]);
      differs = differs || !(a[c] == b[c] || (std::isnan(a[c]) && std::isnan(b[c])));
      if (std::isinf(a[c]) && a[c] == b[c]) {
        ++sums_.count;
        continue;
      }
      infinityDiffers = infinityDiffers || std::isinf(a[c]) || std::isinf(b[c]);
      const double difference = std::fabs(double(a[c]) - double(b[c]));
      if (!std::isfinite(difference)) continue;
      ++sums_.count;
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
    result_.infinityDiffering += infinityDiffers;
    result_.differing += differs;
    sums_.largest = std::max(sums_.largest, largest);
    if (!differs) return;
    if (regions_) regions_->add(x, y, nanA || nanB || infinityDiffers ? INFINITY : largest);
    // A non-finite difference ranks above every number.
    const bool finite = !(nanA || nanB || infinityDiffers);
    keep({x,
          y,
          {a[0], a[1], a[2], a[3]},
          {b[0], b[1], b[2], b[3]},
          finite ? largest : std::numeric_limits<double>::infinity()});
  }

  /// How much of a difference shows over black, and how much over white.
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

  /// Keeps the worst pixels; among equals, the first.
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
    if (regions_) result_.regions = regions_->found();
    for (const detail::MetricRow& metric : detail::metricRows())
      if (metric.ofValues) result_.values[std::string(metric.name)] = metric.ofValues(sums_);
  }

  const detail::ComparedRows& rows_;
  std::optional<detail::Regions> regions_;
  std::size_t worst_;
  Comparison& result_;
  detail::ValueSums sums_;
  double overBlack_ = 0, overWhite_ = 0;
  std::vector<std::uint8_t> codesA_, codesB_;  ///< for rows that are not held
};

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

/// "1 pixel differs", "3 pixels differ".
std::string pixels(std::size_t count, const char* one, const char* several) {
  return std::to_string(count) + (count == 1 ? " pixel " : " pixels ") +
         (count == 1 ? one : several);
}

void judge(const CompareOptions& options, Comparison& result) {
  const bool equality = options.conditions.empty() && options.maxPixels.empty();
  if (equality && result.differing > 0)
    result.failures.push_back(pixels(result.differing, "differs", "differ"));
  for (const auto& [name, threshold] : options.conditions) {
    const double value = result.values.at(name);
    // Written so that NaN fails.
    if (isSimilarity(name) ? value >= threshold : value <= threshold) continue;
    result.failures.push_back(name + " " + number(value) +
                              (isSimilarity(name) ? " is below " : " is above ") +
                              number(threshold));
  }
  for (const PixelLimit& limit : options.maxPixels) {
    const double over = result.values.at("pixels");
    const double side = std::min({options.window, result.width, result.height});
    const double all = options.window > 0 ? side * side : double(result.pixels);
    const double allowed = limit.isShare ? limit.most * all : limit.most;
    if (over <= allowed) continue;
    std::string failure = pixels(std::size_t(over), "is", "are") + " over the tolerance of " +
                          number(options.tolerance) + ", the limit is " + number(allowed);
    if (options.window > 0) failure += " in a window of " + std::to_string(options.window);
    result.failures.push_back(failure);
  }
  const auto refuse = [&](std::size_t count, const char* one, const char* several) {
    if (!equality && count > 0) result.failures.push_back(pixels(count, one, several));
  };
  refuse(result.nanA, "of the baseline is not a number", "of the baseline are not numbers");
  refuse(result.nanB, "is not a number", "are not numbers");
  refuse(result.infinityDiffering, "is infinite in only one of the two",
         "are infinite in only one of the two");
  if (result.pixels == 0) result.failures.push_back("no pixel is left to compare");
  result.same = result.failures.empty();
}

Comparison comparePadded(const StoredImage& a, const StoredImage& b,
                         const CompareOptions& options) {
  const int width = std::max(a.width, b.width), height = std::max(a.height, b.height);
  Comparison result;
  if (std::uint64_t(width) * std::uint64_t(height) <= std::uint64_t(1) << 28) {
    CompareOptions inside = options;
    StoredImage mask;
    if (options.mask) {
      // Pixels outside the mask count.
      const StoredImage& given = *options.mask;
      mask = {width, height, 3, std::vector<std::uint8_t>(std::size_t(3) * width * height, 255)};
      std::vector<float> row(std::size_t(4) * given.width);
      for (int y = 0; y < std::min(height, given.height); ++y) {
        given.encodedRows(y, 1, row.data());
        for (int x = 0; x < std::min(width, given.width); ++x) {
          const float* p = &row[std::size_t(4) * x];
          const std::size_t at = std::size_t(3) * (std::size_t(width) * y + x);
          if (p[0] + p[1] + p[2] < 1.5f) std::fill_n(&std::get<0>(mask.values)[at], 3, 0);
        }
      }
      inside.mask = &mask;
    }
    result = compare(padded(a, width, height), padded(b, width, height), inside);
  }
  result.same = false;
  result.sizesDiffer = true;
  result.failures.insert(result.failures.begin(), detail::sizesText(a, b));
  return result;
}

}  // namespace

namespace {

/// A row of `from` as RGBA, followed by transparent pixels.
template <class Value>
void padRow(const StoredImage& from, int y, int width, Value* out) {
  std::fill_n(out, std::size_t(4) * width, Value(0));
  if (y >= from.height) return;
  std::vector<Value> copy;
  const Value* in = from.heldRows(y, 1, copy);
  const Value opaque = std::is_same_v<Value, float> ? Value(1) : static_cast<Value>(-1);
  for (int x = 0; x < from.width; ++x, in += from.channels, out += 4) {
    for (int c = 0; c < 3; ++c) out[c] = in[from.channels == 1 ? 0 : c];
    out[3] = from.channels == 4 ? in[3] : opaque;
  }
}

}  // namespace

StoredImage padded(const StoredImage& image, int width, int height) {
  StoredImage wide{width, height, 4, {}, image.text, image.unfollowed};
  std::visit(
      [&](const auto& from) {
        using Value = typename std::decay_t<decltype(from)>::value_type;
        auto& to = wide.values.emplace<std::vector<Value>>();
        const std::size_t row = std::size_t(4) * width;
        if (image.window) {
          const auto start = [image, width]() -> detail::RowWindow::Next {
            return [image, width, y = 0](std::byte* out) mutable {
              padRow(image, y++, width, reinterpret_cast<Value*>(out));
            };
          };
          wide.window = std::make_shared<detail::RowWindow>(row * sizeof(Value), height, start);
          return;
        }
        to.resize(row * height);
        for (int y = 0; y < height; ++y) padRow(image, y, width, to.data() + row * y);
      },
      image.values);
  return wide;
}

const std::vector<std::string>& metricNames() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const detail::MetricRow& metric : detail::metricRows()) all.emplace_back(metric.name);
    return all;
  }();
  return names;
}

bool isSimilarity(const std::string& metric) {
  const auto rows = detail::metricRows();
  return std::any_of(rows.begin(), rows.end(), [&](const detail::MetricRow& row) {
    return row.name == metric && row.isSimilarity;
  });
}

Comparison compare(const StoredImage& a, const StoredImage& b, const CompareOptions& options) {
  std::vector<std::string> wanted = options.metrics;
  for (const Condition& condition : options.conditions) wanted.push_back(condition.metric);
  if (!options.maxPixels.empty()) wanted.push_back("pixels");
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
  if (a.width != b.width || a.height != b.height) return comparePadded(a, b, options);
  Comparison result;
  result.width = a.width;
  result.height = a.height;
  detail::ComparedRows rows(a, b, options);
  result.space = rows.space();
  Sums(rows, options, result).run();
  const double none = std::numeric_limits<double>::quiet_NaN();
  const bool empty = std::isnan(result.values["max"]);
  // Equal pictures need no filtering.
  const bool equal = result.differing == 0 && result.nanA == 0 && result.infinityA == 0;
  if (asked("pixels")) {
    std::vector<const detail::ComparedRows*> views{&rows};
    detail::ComparedRows white = rows;
    white.showOver({1, 1, 1});
    if (result.alphaDiffering > 0) views.push_back(&white);
    const auto count = equal ? detail::PixelCount() : detail::countPixels(views, options);
    result.values["pixels"] = double(count.over);
    result.antiAliased = count.antiAliased;
  }
  if (result.seenOverWhite) rows.showOver({1, 1, 1});
  if (asked("ssim"))
    result.values["ssim"] = empty ? none : equal ? 1 : detail::structuralSimilarity(rows);
  std::function<void(int, unsigned char*)> counts;
  if (rows.ignoresSome()) counts = [&](int y, unsigned char* row) { rows.counted(y, row); };
  if (asked("flip")) {
    result.aboveOne = rows.pixelsAboveOne();
    const FlipRows map = asked("hdr-flip") ? FlipRows() : options.flipMap;
    if (equal && !map) {
      result.flip.pixels = result.pixels;
    } else {
      result.flip = flip(rows.linearA(), rows.linearB(), options.flip, map, counts);
    }
    if (empty) result.flip.mean = result.flip.maximum = none;
    result.values["flip"] = result.flip.mean;
  }
  if (asked("hdr-flip")) {
    result.hdrFlip = hdrFlip(rows.linearA(), rows.linearB(), options.flip, options.flipMap, counts);
    if (empty) result.hdrFlip.mean = result.hdrFlip.maximum = none;
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
