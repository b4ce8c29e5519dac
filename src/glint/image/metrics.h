#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace glint::detail {

/// Sums over the values that two pictures are compared by; a is the baseline's.
struct ValueSums {
  double absolute = 0;    ///< of |a - b|
  double square = 0;      ///< of (a - b)^2
  double relative = 0;    ///< of (a - b)^2 / (a^2 + 0.01)
  double largest = 0;     ///< |a - b|
  std::size_t count = 0;  ///< of values: channels times pixels, finite ones alone
};

/// A metric, as docs/image-tests.md defines it.
struct MetricRow {
  std::string_view name;
  /// NaN of nothing. Null: it is of what is seen, and compare() computes it.
  double (*ofValues)(const ValueSums&) = nullptr;
  bool isSimilarity = false;  ///< larger is better
};

/// In the order in which they are reported.
std::span<const MetricRow> metricRows();

}  // namespace glint::detail
