#include "glint/render/probe_error.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace glint {

double floatSpacing(double x) {
  constexpr int smallest = -126, mantissa = 23;
  if (!std::isfinite(x)) return std::numeric_limits<double>::infinity();
  const int exponent = x == 0 ? smallest : std::max(std::ilogb(x), smallest);
  return std::ldexp(1.0, exponent - mantissa);
}

double absoluteError(float got, double truth) {
  if (double(got) == truth) return 0;  // equal infinities too
  const double error = std::abs(double(got) - truth);
  return std::isnan(error) ? std::numeric_limits<double>::infinity() : error;
}

}  // namespace glint
