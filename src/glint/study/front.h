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

/// Where a candidate stands, as far as intervals tell: on the front for sure; dominated for sure;
/// or neither can be told. Of two runs of which each interval holds the true ratio, one never says
/// "on" and the other "dominated" of the same candidate.
struct FrontPlace {
  bool onFront = false;  ///< for sure: faster than each rival that is at least as accurate
  /// Otherwise the index of such a rival than which it is not: the fastest, as far as can be told.
  int dominatedBy = -1;
  /// That rival is faster for sure: the candidate is dominated. Otherwise their times cannot be
  /// told apart.
  bool isSlower = false;
};

/// Errors that differ by less are the same.
inline constexpr double sameError = 0.05;

/// Whether a is faster than b: the upper end of the interval of timeRatio() lies below
/// 1 / (1 + spread). `spread` is the noise floor, by which two
/// measurements of one program may differ.
bool isFaster(std::span<const double> a, std::span<const double> b, double spread);
bool isFaster(const QuartileSamples& a, const QuartileSamples& b, double spread);

/// The Pareto front of time and error. Errors are known, times to an interval: a candidate is on it
/// for sure if it is faster (isFaster) than every other one at least as accurate (by less than
/// sameError, errors are the same), dominated for sure if one of those is faster than it, and else
/// cannot be told. A chain of steps each of which is noise has no member but its ends.
std::vector<FrontPlace> paretoFront(std::span<const FrontCandidate> candidates, double spread);

/// The same by errors and by what tells whether one candidate, by its index, is faster than
/// another; those that are no rivals get a place and take none from others.
std::vector<FrontPlace> paretoFront(std::span<const double> errors,
                                    const std::function<bool(int, int)>& isFasterThan,
                                    const std::function<bool(int)>& isRival = {});

/// The largest spread of which a front is made. Where a machine at rest has one of 1 to 3 %, forms
/// of one light's highlight differ by 3 to 15 % of a frame: with more than this every step of such
/// a front would be noise.
inline constexpr double largestSpread = 0.10;

/// The noise floor from controls, the ratios of measurements of one program: the largest distance
/// from 1 of the ends of their intervals.
double spreadOfControls(std::span<const TimeRatio> ratios);

}  // namespace glint
