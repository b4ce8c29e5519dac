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

struct Interval {
  double low = 0, high = 0;
};

/// The 95 % interval of the median by the bootstrap's percentiles (Efron 1979): 1000 samples drawn
/// from `values` with replacement, always the same ones. {0, 0} of no values.
Interval medianInterval(const std::vector<double>& values);

/// a[i] / b[i] of the rounds that both have: what a and b took at nearly the same moment, so that a
/// machine that slows down or speeds up changes both.
std::vector<double> roundRatios(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace glint
