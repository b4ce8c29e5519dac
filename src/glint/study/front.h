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

struct FrontPlace {
  bool onFront = false;
  int dominatedBy = -1;  ///< index of a member of the front that is as good or better in both
  /// Of what is dominated: that member is faster beyond noise too. Otherwise their times cannot be
  /// told apart, and it is the error alone that speaks for the member.
  bool isSlower = false;
};

/// Errors that differ by less are the same.
inline constexpr double sameError = 0.05;

/// Whether a is faster than b: the upper end of the interval of timeRatio() lies below
/// 1 / (1 + spread). `spread` is the noise floor, by which two
/// measurements of one program may differ.
bool isFaster(std::span<const double> a, std::span<const double> b, double spread);

/// The Pareto front of time and error, as a staircase whose every step is faster than noise: in the
/// order of rising error a candidate joins if it is faster (isFaster) than the member that joined
/// last; with the same error as that one it takes its place. All others are dominated by the last
/// member before them: at least as accurate, and not slower as far as can be told. So what is on it
/// owes nothing to chance unless a step is about as large as the spread itself.
std::vector<FrontPlace> paretoFront(std::span<const FrontCandidate> candidates, double spread);

/// The same by errors and by what tells whether one candidate, by its index, is faster than
/// another.
std::vector<FrontPlace> paretoFront(std::span<const double> errors,
                                    const std::function<bool(int, int)>& isFasterThan);

/// The largest spread of which a front is made. Where a machine at rest has one of 1 to 3 %, forms
/// of one light's highlight differ by 3 to 15 % of a frame: with more than this every step of such
/// a front would be noise.
inline constexpr double largestSpread = 0.10;

/// The noise floor from controls, the ratios of measurements of one program: the largest distance
/// from 1 of the ends of their intervals.
double spreadOfControls(std::span<const TimeRatio> ratios);

}  // namespace glint
