// The errors of a shader's values against their truths, for tests.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "glint/render/probe_error.h"

namespace glint {

/// An error and where it was found.
struct WorstError {
  double value = 0;
  std::size_t row = 0;

  void add(double error, std::size_t at) {
    if (error > value) value = error, row = at;
  }
};

/// The largest errors of many values against their true values.
struct ErrorRecord {
  std::size_t values = 0;
  std::size_t notFinite = 0;  ///< values that are NaN or infinite where the truth is finite
  std::size_t outside = 0;    ///< values whose error is above its bound
  WorstError absolute;        ///< in the values' own unit
  WorstError ulp;             ///< in floatSpacing(truth)
  WorstError ofBound;         ///< divided by its bound: above 1, the bound is broken

  /// A NaN anywhere counts as an infinite error.
  void add(float got, double truth, double bound, std::size_t row);

  /// The largest absolute error of a linear value in levels of an 8-bit picture (before the sRGB
  /// curve).
  double levels() const { return 255 * absolute.value; }

  /// "max 1.2e-07 (3e-05 levels), 2.5 ulp, 0.4 of the bound".
  std::string summary() const;
};

/// The errors of `got`, `width` values a row, against truth(row, component), with the bound
/// bound(row, component) in the values' unit.
template <class Truth, class Bound>
ErrorRecord measureErrors(std::span<const float> got, std::size_t width, Truth truth, Bound bound) {
  ErrorRecord record;
  for (std::size_t i = 0; i < got.size(); ++i)
    record.add(got[i], truth(i / width, i % width), bound(i / width, i % width), i / width);
  return record;
}

inline void ErrorRecord::add(float got, double truth, double bound, std::size_t row) {
  ++values;
  if (!std::isfinite(got) && std::isfinite(truth)) ++notFinite;
  const double error = absoluteError(got, truth);
  if (error == 0) return;
  if (!(error <= bound)) ++outside;
  absolute.add(error, row);
  ulp.add(std::isfinite(error) ? error / floatSpacing(truth) : error, row);
  ofBound.add(error / std::max(bound, std::numeric_limits<double>::min()), row);
}

inline std::string ErrorRecord::summary() const {
  char text[160];
  std::snprintf(text, sizeof text, "max %.3g (%.2g levels), %.3g ulp, %.3g of the bound",
                absolute.value, levels(), ulp.value, ofBound.value);
  return text;
}

/// The arguments of a row of columns, for messages: each float in decimal, exactly, and in
/// hexadecimal. `floats` has the floats in a row of each column; a column of a single row applies
/// to every row.
inline std::string describeRow(const std::vector<std::span<const float>>& columns,
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
