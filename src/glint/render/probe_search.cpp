#include "glint/render/probe_search.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

namespace glint {
namespace {

constexpr std::size_t parents = 64;  // inputs that a round continues from

class Drawer {
 public:
  explicit Drawer(std::uint32_t seed) : random_(seed) {}

  double unit() { return std::uniform_real_distribution<double>()(random_); }
  int below(int n) { return std::uniform_int_distribution<int>(0, n - 1)(random_); }

  /// Uniform over the range, over its floats, or near an end or a special value.
  float fresh(const SearchRange& range) {
    const double low = range.low, high = range.high;
    const double t = unit();
    switch (below(3)) {
      case 0:
        return clamped(float(low + (high - low) * t), range);
      case 1: {
        const double a = floatOrder(range.low), b = floatOrder(range.high);
        return clamped(floatAtOrder(std::int32_t(std::lround(a + (b - a) * t))), range);
      }
      default: {
        const int which = below(int(range.specials.size()) + 2);
        const float at = which == 0   ? range.low
                         : which == 1 ? range.high
                                      : range.specials[std::size_t(which - 2)];
        return near(at, std::exp2(16 * t), range);
      }
    }
  }

  /// A float at most `reach` floats away from x.
  float near(float x, double reach, const SearchRange& range) {
    return clamped(stepFloat(x, std::llround((2 * unit() - 1) * reach)), range);
  }

 private:
  static float clamped(float x, const SearchRange& range) {
    return std::min(std::max(x, range.low), range.high);
  }

  std::mt19937 random_;
};

}  // namespace

std::int32_t floatOrder(float x) {
  const auto bits = std::bit_cast<std::int32_t>(x);
  return bits >= 0 ? bits : std::numeric_limits<std::int32_t>::min() - bits;
}

float floatAtOrder(std::int32_t order) {
  return std::bit_cast<float>(
      order >= 0 ? order : std::int32_t(std::numeric_limits<std::int32_t>::min() - order));
}

float stepFloat(float x, std::int64_t steps) {
  const std::int64_t last = floatOrder(std::numeric_limits<float>::infinity());
  return floatAtOrder(std::int32_t(std::clamp(floatOrder(x) + steps, -last, last)));
}

SearchResult huntWorst(const std::vector<SearchRange>& ranges, const SearchErrors& errors,
                       std::size_t rows, int rounds, std::uint32_t seed) {
  Drawer draw(seed);
  std::vector<SearchResult> best;
  for (int round = 0; round < rounds; ++round) {
    std::vector<std::vector<float>> columns(ranges.size(), std::vector<float>(rows));
    // A quarter of each round starts afresh: the worst may be far from those found so far.
    for (std::size_t row = 0; row < rows; ++row) {
      const bool fresh = best.empty() || row % 4 == 0;
      const std::size_t parent = fresh ? 0 : row % best.size();
      const int one = draw.below(int(ranges.size()) + 1);  // the last value: change all of them
      const double shrink = draw.unit();
      for (std::size_t a = 0; a < ranges.size(); ++a) {
        float& x = columns[a][row];
        if (fresh) {
          x = draw.fresh(ranges[a]);
          continue;
        }
        x = best[parent].input[a];
        if (one != int(a) && one != int(ranges.size())) continue;
        const double span = double(floatOrder(ranges[a].high)) - double(floatOrder(ranges[a].low));
        x = draw.near(x, std::max(std::pow(std::max(span / 4, 2.0), shrink), 1.5), ranges[a]);
      }
    }
    const std::vector<double> found = errors(columns);
    std::vector<std::size_t> order(rows);
    std::iota(order.begin(), order.end(), std::size_t(0));
    const std::size_t kept = std::min(parents, rows);
    std::partial_sort(order.begin(), order.begin() + std::ptrdiff_t(kept), order.end(),
                      [&](std::size_t i, std::size_t j) { return found[i] > found[j]; });
    for (std::size_t i = 0; i < kept; ++i) {
      SearchResult result{{}, found[order[i]]};
      for (const std::vector<float>& column : columns) result.input.push_back(column[order[i]]);
      best.push_back(std::move(result));
    }
    std::stable_sort(best.begin(), best.end(), [](const SearchResult& a, const SearchResult& b) {
      return a.error > b.error;
    });
    best.resize(std::min(best.size(), parents));
  }
  return best.empty() ? SearchResult{} : best.front();
}

}  // namespace glint
