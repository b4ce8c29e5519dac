#pragma once

#include <functional>
#include <span>
#include <vector>

#include "glint/study/statistics.h"

namespace glint {

/// A variant as the front sees it.
struct FrontCandidate {
  double error = 0;
  std::span<const double> rounds;  ///< times, of all candidates measured in turn
};

/// Where a candidate is, as far as the intervals show: certainly on the front, certainly dominated,
/// or undecided. If the intervals of two runs hold the true ratios, one run never says "on" and the
/// other "dominated" of the same candidate.
struct FrontPlace {
  bool onFront = false;  ///< certain: faster than each rival that is at least as accurate
  /// Otherwise the index of such a rival that it is not faster than: the fastest, as far as can be
  /// told.
  int dominatedBy = -1;
  /// That rival is certainly faster: the candidate is dominated. Otherwise their times cannot be
  /// told apart.
  bool isSlower = false;
};

/// Errors that differ by a smaller share count as the same.
inline constexpr double sameError = 0.05;

/// Whether a is faster than b: the upper end of the interval of timeRatio() lies below
/// 1 / (1 + spread). `spread` is the noise floor, by which two
/// measurements of one program may differ.
bool isFaster(std::span<const double> a, std::span<const double> b, double spread);
bool isFaster(const QuartileSamples& a, const QuartileSamples& b, double spread);

/// The Pareto front of time and error. Errors are known, times only to an interval. A candidate is
/// certainly on the front if it is faster (isFaster) than every other one at least as accurate
/// (errors that differ by less than sameError are the same), certainly dominated if one of those is
/// faster than it, and otherwise undecided. Of a chain whose steps are all noise, only the ends are
/// on the front.
std::vector<FrontPlace> paretoFront(std::span<const FrontCandidate> candidates, double spread);

/// The same from errors and a function that says whether one candidate, by its index, is faster
/// than another. Candidates that are not rivals get a place but take none from others.
std::vector<FrontPlace> paretoFront(std::span<const double> errors,
                                    const std::function<bool(int, int)>& isFasterThan,
                                    const std::function<bool(int)>& isRival = {});

/// The largest spread with which a front is made. On a machine at rest the spread is 1 to 3 %, and
/// forms of one light's highlight differ by 3 to 15 % of a frame: with more than this every step of
/// such a front would be noise.
inline constexpr double largestSpread = 0.10;

/// The noise floor from controls, the ratios of measurements of one program: the largest distance
/// from 1 of the ends of their intervals.
double spreadOfControls(std::span<const TimeRatio> ratios);

}  // namespace glint
