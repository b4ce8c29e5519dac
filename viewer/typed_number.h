#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace glint::viewer {

/// The result of reading a number that a person typed.
struct TypedNumber {
  std::optional<double> value;  ///< within the limits; empty on an error
  std::string error;            ///< says what is expected, in one line; empty if there is a value
};

/// Reads a number or an arithmetic expression: + - * / ^, parentheses, sqrt(x), pi. Both a comma
/// and a point are decimal points: "0,5" is 0.5. Nothing is clamped: a value that is not finite or
/// not in [min, max] is an error; min == max means no limits.
TypedNumber readTypedNumber(std::string_view text, double min, double max);

}  // namespace glint::viewer
