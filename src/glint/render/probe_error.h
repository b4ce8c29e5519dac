#pragma once

namespace glint {

/// The distance between neighbouring floats at x: 2^-23 times the power of two at or below |x|, and
/// 2^-149 for subnormal x. The ulp that errors are counted in.
double floatSpacing(double x);

/// |got - truth|; infinite where only one of them is finite or either is NaN, 0 where both are the
/// same infinity.
double absoluteError(float got, double truth);

}  // namespace glint
