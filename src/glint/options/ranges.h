#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace glint {

namespace detail {

/// Checks that text is a Number of [least, most]. Unlike CLI::Range it refuses NaN, which is
/// neither below nor above a limit.
template <typename Number>
CLI::Validator inRange(const std::string& kind, Number least, Number most) {
  return {[=](std::string& text) {
            Number value{};
            if (CLI::detail::lexical_cast(text, value) && value >= least && value <= most)
              return std::string();
            return "'" + text + "': give a " + kind + " from " + CLI::detail::to_string(least) +
                   " to " + CLI::detail::to_string(most);
          },
          ""};
}

}  // namespace detail

/// Check of an option's value, a number of [least, most].
inline CLI::Validator numberIn(double least, double most) {
  return detail::inRange("number", least, most);
}

/// Check of an option's value, a whole number of [least, most].
inline CLI::Validator wholeNumberIn(int least, int most) {
  return detail::inRange("whole number", least, most);
}

}  // namespace glint
