#pragma once

#include <cstddef>
#include <vector>

namespace glint {

/// The order statistics of measurements, in their unit.
struct Spread {
  double minimum = 0, lowerQuartile = 0, median = 0, upperQuartile = 0, maximum = 0;
  std::size_t count = 0;
};

/// The q-quantile of values, q in [0, 1], linear between neighbours (Hyndman and Fan's type 7):
/// 0 is the smallest, 0.5 the median, 1 the largest. NaN of no values.
double quantile(std::vector<double> values, double q);

/// All zero of no values.
Spread spreadOf(const std::vector<double>& values);

}  // namespace glint
