#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace glint {

/// The order statistics of measurements, in their unit.
struct Spread {
  double minimum = 0, lowerQuartile = 0, median = 0, upperQuartile = 0, maximum = 0;
  std::size_t count = 0;
};

/// The q-quantile of values, q in [0, 1], linear between neighbours (Hyndman and Fan's type 7):
/// 0 is the smallest, 0.5 the median, 1 the largest. NaN for no values.
double quantile(std::vector<double> values, double q);

/// All zero for no values.
Spread spreadOf(const std::vector<double>& values);

/// How the times of a and b compare, measured in turn.
struct TimeRatio {
  double value = 0, low = 0, high = 0;  ///< of a to b, with its 95 % interval; all 0 for no rounds
};

/// The lower quartile of rounds, and those of 1000 bootstrap samples. Which rounds are drawn
/// depends only on their number, so that samples with the same index use the same rounds in every
/// object.
struct QuartileSamples {
  double value = 0;
  std::vector<double> drawn;  ///< empty if there are no rounds
};
QuartileSamples quartileSamples(std::span<const double> rounds);

/// The ratio of the lower quartiles of the rounds that both have. Other work on the machine, or an
/// unlucky placement of one build of a program, only ever adds time, and the lower quartile leaves
/// that out as long as it affects fewer than three rounds of four. Bootstrap: rounds are drawn for
/// a and b together, so that a machine that slows down or speeds up changes both.
TimeRatio timeRatio(std::span<const double> a, std::span<const double> b);
/// Both must have the same number of rounds.
TimeRatio timeRatio(const QuartileSamples& a, const QuartileSamples& b);

/// The same for any function of the lower quartiles of `times`, in their order. All were measured
/// in turn and have the same rounds.
TimeRatio quartileFunction(std::span<const std::span<const double>> times,
                           const std::function<double(std::span<const double>)>& function);

}  // namespace glint
