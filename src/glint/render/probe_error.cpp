#include "glint/render/probe_error.h"

#include <algorithm>
#include <cstdio>

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

void ErrorRecord::add(float got, double truth, double bound, std::size_t row) {
  ++values;
  if (!std::isfinite(got) && std::isfinite(truth)) ++notFinite;
  const double error = absoluteError(got, truth);
  if (error == 0) return;
  if (!(error <= bound)) ++outside;
  absolute.add(error, row);
  ulp.add(std::isfinite(error) ? error / floatSpacing(truth) : error, row);
  ofBound.add(error / std::max(bound, std::numeric_limits<double>::min()), row);
}

std::string ErrorRecord::summary() const {
  char text[160];
  std::snprintf(text, sizeof text, "max %.3g (%.2g levels), %.3g ulp, %.3g of the bound",
                absolute.value, levels(), ulp.value, ofBound.value);
  return text;
}

std::string describeRow(const std::vector<std::span<const float>>& columns,
                        const std::vector<std::size_t>& floats, std::size_t row) {
  std::string text = "(";
  for (std::size_t a = 0; a < columns.size(); ++a) {
    const std::size_t first = columns[a].size() == floats[a] ? 0 : row * floats[a];
    for (std::size_t i = first; i < first + floats[a]; ++i) {
      char value[64];
      std::snprintf(value, sizeof value, "%s%.9g [%a]", text.size() > 1 ? ", " : "",
                    double(columns[a][i]), double(columns[a][i]));
      text += value;
    }
  }
  return text + ")";
}

}  // namespace glint
