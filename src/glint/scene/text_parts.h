#pragma once

// Building blocks for the parsers of option texts.

#include <charconv>
#include <string>
#include <system_error>
#include <vector>

#include "glint/image/error.h"
#include "glint/scene/look_text.h"

namespace glint::parts {

/// Splits at a separator; at least one part, which may be empty.
inline std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts(1);
  for (char c : text) {
    if (c == separator)
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

/// Throws an InputError for a text that is not as expected.
[[noreturn]] inline void refuse(const std::string& what, const std::string& text,
                                const std::string& expected) {
  throw InputError(what + ": '" + text + "' is not " + expected);
}

/// Reads a number that takes up the whole text, optionally with a leading +.
template <typename Number>
bool readAll(const std::string& text, Number& value) {
  const char *begin = text.data(), *end = begin + text.size();
  if (begin != end && *begin == '+') ++begin;
  const auto [stop, error] = std::from_chars(begin, end, value);
  return error == std::errc() && stop == end;
}

inline std::string rangeText(double min, double max) {
  return "from " + numberText(min) + " to " + numberText(max);
}

}  // namespace glint::parts
