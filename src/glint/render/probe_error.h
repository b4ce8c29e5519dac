#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace glint {

/// The distance between neighbouring floats at x: 2^-23 times the power of two at or below |x|, and
/// 2^-149 for subnormal x. The ulp that errors are counted in.
double floatSpacing(double x);

/// |got - truth|; infinite where only one of them is finite or either is NaN, 0 where both are the
/// same infinity.
double absoluteError(float got, double truth);

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

/// The arguments of a row of columns, for messages: each float in decimal, exactly, and in
/// hexadecimal. `floats` has the floats in a row of each column; a column of a single row applies
/// to every row.
std::string describeRow(const std::vector<std::span<const float>>& columns,
                        const std::vector<std::size_t>& floats, std::size_t row);

}  // namespace glint
