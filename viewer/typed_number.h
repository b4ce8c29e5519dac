#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace glint::viewer {

/// What a text that a person typed says.
struct TypedNumber {
  std::optional<double> value;  ///< within the limits; empty if there is an error
  std::string error;            ///< says what is expected, for one line; empty if there is a value
};

/// Reads a number or an expression of numbers: + - * / ^, brackets, sqrt(x), pi. A comma is a
/// decimal point, as a point is: "0,5" is 0.5. Nothing is clamped: what is not finite or not in
/// [min, max] is an error; min == max means no limits.
TypedNumber readTypedNumber(std::string_view text, double min, double max);

}  // namespace glint::viewer
