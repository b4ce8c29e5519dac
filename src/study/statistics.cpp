#include "glint/study/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace glint {

double quantile(std::vector<double> values, double q) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const double place = std::clamp(q, 0.0, 1.0) * double(values.size() - 1);
  const auto below = values.begin() + std::ptrdiff_t(place);
  std::nth_element(values.begin(), below, values.end());
  const double rest = place - std::floor(place);
  if (rest == 0) return *below;
  const double above = *std::min_element(below + 1, values.end());
  return *below + rest * (above - *below);
}

Spread spreadOf(const std::vector<double>& values) {
  if (values.empty()) return {};
  return {quantile(values, 0),    quantile(values, 0.25), quantile(values, 0.5),
          quantile(values, 0.75), quantile(values, 1),    values.size()};
}

}  // namespace glint
