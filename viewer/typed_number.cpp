#include "typed_number.h"

#include <charconv>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace glint::viewer {
namespace {

constexpr int mostDepth = 32;  // of parentheses, powers and signs: no text overflows the stack

// Recursive descent parser; skips the rest after an error.
class Expression {
 public:
  explicit Expression(std::string_view text) : rest_(text) {}

  std::optional<double> value() {
    const double v = sum();
    skipSpaces();
    if (!rest_.empty()) fault_ = true;
    return fault_ ? std::nullopt : std::optional(v);
  }

 private:
  void skipSpaces() {
    while (!rest_.empty() && (rest_.front() == ' ' || rest_.front() == '\t'))
      rest_.remove_prefix(1);
  }

  bool taken(std::string_view what) {
    skipSpaces();
    if (!rest_.starts_with(what)) return false;
    rest_.remove_prefix(what.size());
    return true;
  }

  double sum() {
    double v = product();
    while (!fault_) {
      if (taken("+"))
        v += product();
      else if (taken("-"))
        v -= product();
      else
        break;
    }
    return v;
  }

  double product() {
    double v = signedPower();
    while (!fault_) {
      if (taken("*"))
        v *= signedPower();
      else if (taken("/"))
        v /= signedPower();
      else
        break;
    }
    return v;
  }

  // -2^2 is -4, 2^-1 is 0.5, 2^3^2 is 2^9.
  double signedPower() {
    if (++depth_ > mostDepth) fault_ = true;
    double v = 0;
    if (fault_) {
      return v;
    } else if (taken("-")) {
      v = -signedPower();
    } else if (taken("+")) {
      v = signedPower();
    } else {
      v = atom();
      if (taken("^")) v = std::pow(v, signedPower());
    }
    --depth_;
    return v;
  }

  double atom() {
    if (taken("pi")) return std::numbers::pi;
    const bool root = taken("sqrt");
    if (taken("(")) {
      const double v = sum();
      if (!taken(")")) fault_ = true;
      return root ? std::sqrt(v) : v;
    }
    if (root) fault_ = true;
    return number();
  }

  double number() {
    skipSpaces();
    std::string digits;
    for (const char c : rest_) {
      const bool exponentSign = (c == '+' || c == '-') && !digits.empty() &&
                                (digits.back() == 'e' || digits.back() == 'E');
      if (!(c >= '0' && c <= '9') && c != '.' && c != ',' && !exponentSign &&
          !((c == 'e' || c == 'E') && !digits.empty()))
        break;
      digits += c == ',' ? '.' : c;
    }
    double v = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), v);
    if (error != std::errc() || end != digits.data() + digits.size()) fault_ = true;
    rest_.remove_prefix(digits.size());
    return v;
  }

  std::string_view rest_;
  int depth_ = 0;
  bool fault_ = false;
};

std::string shortText(double v) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", v);
  return text;
}

}  // namespace

TypedNumber readTypedNumber(std::string_view text, double min, double max) {
  const std::string limits =
      min < max ? "from " + shortText(min) + " to " + shortText(max) : std::string();
  const auto value = Expression(text).value();
  if (!value || !std::isfinite(*value)) {
    std::string error = value ? "not a finite number" : "not a number";
    return {
        {},
        error + ": type a number such as 0.5, 0,5 or 1/3" + (limits.empty() ? "" : ", " + limits)};
  }
  if (min < max && !(*value >= min && *value <= max))
    return {{}, shortText(*value) + " is out of range: " + limits};
  return {value, {}};
}

}  // namespace glint::viewer
