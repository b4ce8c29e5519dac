#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace glint {

/// Help for people: an option with its value on one line, what it does below, wrapped.
class HelpFormatter : public CLI::Formatter {
 public:
  std::string make_option(const CLI::Option*, bool isPositional) const override;
  std::string make_usage(const CLI::App*, std::string name) const override;
};

/// What is wrong with the command line, in one line: for an unknown option or command with the
/// nearest known one.
std::string usageMessage(const CLI::App&, const CLI::ParseError&, int argc, char** argv);

}  // namespace glint
