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

/// How the times of a and b compare, measured in turn.
struct TimeRatio {
  double value = 0, low = 0, high = 0;  ///< of a to b, with its 95 % interval; all 0 of no rounds
};

/// The lower quartile of rounds, and those of 1000 samples of them: always the same rounds for
/// the same number of them, so that samples of one place are of the same rounds in all.
struct QuartileSamples {
  double value = 0;
  std::vector<double> drawn;  ///< none of no rounds
};
QuartileSamples quartileSamples(std::span<const double> rounds);

/// The ratio of the lower quartiles of the rounds that both have. What takes a machine away for a
/// while, or puts one build of a program in an unlucky place, only ever adds time, and the lower
/// quartile leaves it out as long as it hits less than three rounds of four. Bootstrap: rounds are
/// drawn for a and b together, so that a machine that slows down or speeds up changes both.
TimeRatio timeRatio(std::span<const double> a, std::span<const double> b);
/// Of as many rounds of each.
TimeRatio timeRatio(const QuartileSamples& a, const QuartileSamples& b);

/// The same of any function of the lower quartiles of times that were measured in turn, in their
/// order: all have the same rounds.
TimeRatio quartileFunction(std::span<const std::span<const double>> times,
                           const std::function<double(std::span<const double>)>& function);

}  // namespace glint
