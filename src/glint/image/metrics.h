#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace glint::detail {

/// Sums over the compared values of two pictures; a is the baseline's.
struct ValueSums {
  double absolute = 0;    ///< of |a - b|
  double square = 0;      ///< of (a - b)^2
  double relative = 0;    ///< of (a - b)^2 / (a^2 + 0.01)
  double largest = 0;     ///< |a - b|
  std::size_t count = 0;  ///< number of values: channels times pixels, finite ones only
};

/// A metric, as docs/image-tests.md defines it.
struct MetricRow {
  std::string_view name;
  /// NaN if there are no values. Null for perceptual metrics, which compare() computes.
  double (*ofValues)(const ValueSums&) = nullptr;
  bool isSimilarity = false;  ///< larger is better
};

/// In the order in which they are reported.
std::span<const MetricRow> metricRows();

}  // namespace glint::detail
