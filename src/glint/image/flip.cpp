#include "glint/image/flip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <utility>

#include "glint/image/error.h"
#include "glint/image/flip_kernels.h"
#include "glint/image/task.h"

namespace glint {
namespace {

using Counts = std::function<void(int y, unsigned char* row)>;

/// The rows of one picture around the current one: converted, and filtered along x where requested.
class Ring {
 public:
  Ring(const PixelRows& picture, const detail::FlipFilters& filters)
      : picture_(picture),
        filters_(filters),
        rgba_(std::size_t(4) * picture.width),
        blocks_(blocksOf(picture.width)),
        // Whole blocks may be read beyond the width by the comparison.
        stride_(blocks_ * detail::flipBlock),
        rows_(std::size_t(size()), detail::FlipRow(picture.width, filters.radius)),
        planes_(std::size_t(size()) * detail::flipPlanes * stride_),
        filtered_(std::size_t(size()) * blocks_),
        around_(std::size_t(size())) {}

  static std::size_t blocksOf(int width) {
    return std::size_t(width + detail::flipBlock - 1) / detail::flipBlock;
  }
  std::size_t stride() const { return stride_; }
  const std::vector<float>& rgba() const { return rgba_; }

  void read(int y) {
    picture_.read(y, 1, rgba_.data());
    const std::size_t at = std::size_t(y % size());
    detail::flipConvertRow(rgba_.data(), picture_.width, filters_.radius, rows_[at]);
    std::fill_n(filtered_.begin() + std::ptrdiff_t(at * blocks_), blocks_, 0);
  }

  /// The rows around y, filtered in the blocks [first, last). Rows beyond the edges repeat the edge
  /// rows.
  const float* const* around(int y, std::size_t first, std::size_t last) {
    for (int k = 0; k < size(); ++k) {
      const int row = std::clamp(y + k - filters_.radius, 0, picture_.height - 1);
      const std::size_t at = std::size_t(row % size());
      float* const planes = planes_.data() + at * detail::flipPlanes * stride_;
      for (std::size_t block = first; block < last; ++block) {
        if (std::exchange(filtered_[at * blocks_ + block], 1)) continue;
        const int begin = int(block) * detail::flipBlock;
        detail::flipFilterRow(filters_, rows_[at], begin,
                              std::min(begin + detail::flipBlock, picture_.width), planes, stride_);
      }
      around_[std::size_t(k)] = planes;
    }
    return around_.data();
  }

 private:
  int size() const { return 2 * filters_.radius + 1; }

  const PixelRows& picture_;
  const detail::FlipFilters& filters_;
  std::vector<float> rgba_;
  std::size_t blocks_, stride_;
  std::vector<detail::FlipRow> rows_;
  std::vector<float> planes_;
  std::vector<unsigned char> filtered_;  ///< by row and block
  std::vector<const float*> around_;
};

/// The errors of consecutive rows. Where both pictures are equal within the filters' radius, the
/// error is 0 without any filtering: in most pairs that is nearly everywhere.
class RowErrors {
 public:
  RowErrors(const PixelRows& reference, const PixelRows& test, const detail::FlipFilters& filters,
            int first)
      : filters_(filters),
        width_(reference.width),
        height_(reference.height),
        a_(reference, filters),
        b_(test, filters),
        next_(std::max(0, first - filters.radius)),
        lastDifferent_(Ring::blocksOf(width_), std::numeric_limits<int>::min()) {}

  void compute(int y, float* errors) {
    for (; next_ <= std::min(height_ - 1, y + filters_.radius); ++next_) read();
    const std::size_t blocks = lastDifferent_.size();
    for (std::size_t first = 0, last = 0; first < blocks; first = last) {
      const bool equal = isEqual(first, y);
      for (last = first + 1; last < blocks && isEqual(last, y) == equal;) ++last;
      const int begin = int(first) * detail::flipBlock;
      const int end = std::min(int(last) * detail::flipBlock, width_);
      if (equal) {
        std::fill(errors + begin, errors + end, 0.0f);
        continue;
      }
      const float* const* rows = a_.around(y, first, last);
      detail::flipCompareRow(filters_, rows, b_.around(y, first, last), begin, end, a_.stride(),
                             errors);
    }
  }

 private:
  void read() {
    a_.read(next_);
    b_.read(next_);
    constexpr std::size_t values = std::size_t(4) * detail::flipBlock;
    for (std::size_t block = 0; block < lastDifferent_.size(); ++block) {
      const std::size_t at = block * values, count = std::min(values, a_.rgba().size() - at);
      if (std::memcmp(&a_.rgba()[at], &b_.rgba()[at], count * sizeof(float)) != 0)
        lastDifferent_[block] = next_;
    }
  }

  /// Whether there is no differing pixel within the filters' radius of this block in row y.
  bool isEqual(std::size_t block, int y) const {
    const auto reach =
        std::size_t(filters_.radius + detail::flipBlock - 1) / std::size_t(detail::flipBlock);
    const std::size_t begin = block > reach ? block - reach : 0,
                      end = std::min(block + reach + 1, lastDifferent_.size());
    return std::all_of(lastDifferent_.begin() + std::ptrdiff_t(begin),
                       lastDifferent_.begin() + std::ptrdiff_t(end),
                       [&](int row) { return row < y - filters_.radius; });
  }

  const detail::FlipFilters& filters_;
  int width_, height_;
  Ring a_, b_;
  int next_;                        ///< next row to read
  std::vector<int> lastDifferent_;  ///< last differing row read, by block; INT_MIN: none
};

void check(const PixelRows& reference, const PixelRows& test, const FlipOptions& options) {
  if (reference.width != test.width || reference.height != test.height || reference.width < 1 ||
      reference.height < 1)
    throw Error("FLIP of pictures of different sizes, or of none");
  if (!(options.pixelsPerDegree > 0 && options.pixelsPerDegree <= 1000))
    throw InputError("FLIP at " + std::to_string(options.pixelsPerDegree) +
                     " pixels per degree: give more than 0 and at most 1000");
}

/// Calls use(y, errors) for all rows, in order.
void forErrors(const PixelRows& reference, const PixelRows& test, const FlipOptions& options,
               const FlipRows& use) {
  check(reference, test, options);
  const detail::FlipFilters filters(options.pixelsPerDegree);
  const int width = reference.width, height = reference.height;
  // Ranges of rows for the threads: long, since the rows around a range are filtered twice; and
  // handed out in rounds, since the map of a huge picture must not be held whole.
  constexpr int longest = 288;
  int threads = std::min(threadsFor(options.threads), height);
  if (const int reach = std::max(reference.reach, test.reach); reach > 0)
    threads = std::clamp((reach - 4 * filters.radius) / longest, 1, threads);
  const int rounds = std::max(1, (height + longest * threads - 1) / (longest * threads));
  const int piece = std::max(1, (height + rounds * threads - 1) / (rounds * threads));
  std::vector<float> errors(std::size_t(width) * std::size_t(piece) * std::size_t(threads));
  for (int first = 0; first < height; first += piece * threads) {
    inParallel(threads, std::size_t(threads), [&](std::size_t t, int) {
      const int begin = first + int(t) * piece, end = std::min(height, begin + piece);
      if (begin >= end) return;
      float* out = errors.data() + std::size_t(width) * t * std::size_t(piece);
      RowErrors errorsOf(reference, test, filters, begin);
      for (int y = begin; y < end; ++y, out += width) errorsOf.compute(y, out);
    });
    for (int y = first; y < std::min(height, first + piece * threads); ++y)
      use(y, errors.data() + std::size_t(width) * std::size_t(y - first));
  }
}

/// Sums up rows of errors.
class Pool {
 public:
  Pool(int width, const FlipRows& map, const Counts& counts)
      : width_(width), map_(map), counts_(counts), counted_(std::size_t(width), 1) {}

  void add(int y, const float* errors) {
    if (counts_) counts_(y, counted_.data());
    double sum = 0;
    for (int x = 0; x < width_; ++x) {
      if (!counted_[std::size_t(x)]) continue;
      sum += errors[x];
      weights_[std::size_t(std::min(errors[x], 1.0f) * float(weights_.size() - 1))] += errors[x];
      result.maximum = std::max(result.maximum, double(errors[x]));
      ++result.pixels;
    }
    sum_ += sum;
    if (map_) map_(y, errors);
  }

  FlipResult finish() {
    result.mean = result.pixels > 0 ? sum_ / double(result.pixels) : 0;
    double all = 0, below = 0;
    for (const double weight : weights_) all += weight;
    for (std::size_t i = 0; i < weights_.size() && all > 0; ++i) {
      const double before = below / all, error = (double(i) + 0.5) / double(weights_.size() - 1);
      below += weights_[i];
      for (const auto& [part, quantile] : {std::pair{0.25, &result.firstQuartile},
                                           {0.5, &result.median},
                                           {0.75, &result.thirdQuartile}})
        if (before < part && below / all >= part) *quantile = std::min(error, 1.0);
    }
    return result;
  }

  FlipResult result;

 private:
  int width_;
  const FlipRows& map_;
  const Counts& counts_;
  std::vector<unsigned char> counted_;
  std::vector<double> weights_ = std::vector<double>(65537);  ///< sums of errors, binned by error
  double sum_ = 0;
};

/// (a x^2 + b x + c) / (d x^2 + e x + f).
using ToneCurve = std::array<double, 6>;

/// ACES as fitted by Narkowicz, including the factor 0.6 that the paper takes out of the exposure;
/// Hable's filmic curve; Reinhard's.
const ToneCurve& curveOf(ToneMapper mapper) {
  static constexpr ToneCurve aces{0.6 * 0.6 * 2.51, 0.6 * 0.03, 0,
                                  0.6 * 0.6 * 2.43, 0.6 * 0.59, 0.14};
  static constexpr ToneCurve hable{0.231683, 0.013791, 0, 0.18, 0.3, 0.018};
  static constexpr ToneCurve reinhard{0, 1, 0, 0, 1, 1};
  return mapper == ToneMapper::aces ? aces : mapper == ToneMapper::hable ? hable : reinhard;
}

/// The exposures (in stops) that the paper tries for a reference: from the one at which the
/// brightest pixel reaches 0.85 on the tone curve to the one at which the median does.
void exposuresOf(const PixelRows& reference, const FlipOptions& options, FlipResult& result) {
  const ToneCurve& curve = curveOf(options.toneMapper);
  const double t = 0.85;
  const double a = curve[0] - t * curve[3], b = curve[1] - t * curve[4],
               c = curve[2] - t * curve[5];
  const double half = a == 0 ? 0 : -0.5 * b / a;
  const double reached = a == 0 ? -c / b : half + std::sqrt(half * half - c / a);
  std::vector<float> luminances;
  luminances.reserve(std::size_t(reference.width) * std::size_t(reference.height));
  std::vector<float> row(std::size_t(4) * reference.width);
  for (int y = 0; y < reference.height; ++y) {
    reference.read(y, 1, row.data());
    for (int x = 0; x < reference.width; ++x) {
      const float* p = &row[std::size_t(4) * x];
      const float luminance = 0.2126f * p[0] + 0.7152f * p[1] + 0.0722f * p[2];
      luminances.push_back(std::isfinite(luminance) ? luminance : 0);
    }
  }
  const auto middle = luminances.begin() + std::ptrdiff_t(luminances.size() / 2);
  const double brightest = *std::max_element(luminances.begin(), luminances.end());
  std::nth_element(luminances.begin(), middle, luminances.end());
  // The paper leaves these exposures undefined for a picture that is black, or half black. Sixteen
  // stops show whatever is there.
  const auto stops = [&](double luminance, double other) {
    return luminance > 0 ? std::log2(reached / luminance) : other;
  };
  result.startExposure = options.startExposure.value_or(stops(brightest, 0));
  result.stopExposure = options.stopExposure.value_or(
      std::max(result.startExposure, stops(*middle, result.startExposure + 16)));
  if (!(result.stopExposure >= result.startExposure))
    throw InputError("HDR-FLIP from exposure " + std::to_string(result.startExposure) + " to " +
                     std::to_string(result.stopExposure) + ": give a start not above the stop");
  result.exposures =
      options.exposures > 0
          ? options.exposures
          : int(std::clamp(std::ceil(result.stopExposure - result.startExposure), 2.0, 64.0));
}

PixelRows toneMapped(const PixelRows& picture, ToneMapper mapper, double exposure) {
  const auto scale = static_cast<float>(std::exp2(exposure));
  const ToneCurve& curve = curveOf(mapper);
  std::array<float, 6> k{};
  for (std::size_t i = 0; i < 6; ++i) k[i] = static_cast<float>(curve[i]);
  PixelRows mapped = picture;
  mapped.read = [&picture, scale, k, mapper](int first, int count, float* rgba) {
    picture.read(first, count, rgba);
    const std::size_t values = std::size_t(4) * picture.width * count;
    for (std::size_t i = 0; i < values; i += mapper == ToneMapper::reinhard ? 4 : 1) {
      if (mapper == ToneMapper::reinhard) {
        float* const p = rgba + i;
        const float luminance = scale * (0.2126f * p[0] + 0.7152f * p[1] + 0.0722f * p[2]);
        for (int c = 0; c < 3; ++c) p[c] = p[c] * scale / (1 + luminance);
        continue;
      }
      const float x = rgba[i] * scale, s = x * x;
      const float over = s * k[0] + x * k[1] + k[2], under = s * k[3] + x * k[4] + k[5];
      // Beyond 1e15 the squares overflow, but the curve has long been above 1.
      rgba[i] = x > 1e15f ? 1 : over / under;
    }
  };
  return mapped;
}

}  // namespace

double pixelsPerDegree(double distance, double pixels, double width) {
  return distance * pixels / width * (std::numbers::pi / 180);
}

FlipResult flip(const PixelRows& reference, const PixelRows& test, const FlipOptions& options,
                const FlipRows& map, const Counts& counts) {
  Pool pool(reference.width, map, counts);
  forErrors(reference, test, options, [&](int y, const float* errors) { pool.add(y, errors); });
  return pool.finish();
}

FlipResult hdrFlip(const PixelRows& reference, const PixelRows& test, const FlipOptions& options,
                   const FlipRows& map, const Counts& counts) {
  check(reference, test, options);
  Pool pool(reference.width, map, counts);
  exposuresOf(reference, options, pool.result);
  const FlipResult found = pool.result;
  const auto width = std::size_t(reference.width);
  std::vector<float> largest(width * std::size_t(reference.height));
  for (int i = 0; i < found.exposures; ++i) {
    const double exposure = found.startExposure + i * (found.stopExposure - found.startExposure) /
                                                      std::max(1, found.exposures - 1);
    const PixelRows a = toneMapped(reference, options.toneMapper, exposure),
                    b = toneMapped(test, options.toneMapper, exposure);
    forErrors(a, b, options, [&](int y, const float* errors) {
      float* row = largest.data() + width * std::size_t(y);
      for (std::size_t x = 0; x < width; ++x) row[x] = std::max(row[x], errors[x]);
    });
  }
  for (int y = 0; y < reference.height; ++y) pool.add(y, largest.data() + width * std::size_t(y));
  return pool.finish();
}

}  // namespace glint
