#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <type_traits>

namespace glint {

/// Check of an option's value, a number of [least, most]. Unlike CLI::Range it refuses NaN, which
/// is neither below nor above a limit.
template <typename Number>
CLI::Validator numberIn(Number least, Number most) {
  const std::string kind = std::is_integral_v<Number> ? "whole number" : "number";
  return {[=](std::string& text) {
            Number value{};
            if (CLI::detail::lexical_cast(text, value) && value >= least && value <= most)
              return std::string();
            return "'" + text + "': give a " + kind + " from " + CLI::detail::to_string(least) +
                   " to " + CLI::detail::to_string(most);
          },
          ""};
}

/// Adds an option; `type` stands for its value in the help.
template <class T>
CLI::Option* addOption(CLI::App& command, const char* name, T& value, const char* type,
                       const std::string& help) {
  return command.add_option(name, value, help)->type_name(type);
}

/// The same for a number from `low` to `high`, which the help says in its own words.
template <class T, class Number>
CLI::Option* addNumber(CLI::App& command, const char* name, T& value, const char* type, Number low,
                       Number high, const std::string& help) {
  return addOption(command, name, value, type, help)->check(numberIn(low, high));
}

/// The same for an option that may be given several times, each time with one value.
template <class T>
CLI::Option* addList(CLI::App& command, const char* name, T& values, const char* type,
                     const std::string& help) {
  return addOption(command, name, values, type, help)
      ->expected(1)
      ->allow_extra_args(false)
      ->take_all();
}

}  // namespace glint
