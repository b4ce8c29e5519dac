#pragma once

#include <CLI/CLI.hpp>
#include <initializer_list>
#include <string>

namespace glint {

/// Help within 80 columns: an option with its value on one line, its description below, wrapped;
/// sections separated by an empty line; last the footer with a command's examples.
class HelpFormatter : public CLI::FormatterBase {
 public:
  std::string make_help(const CLI::App*, std::string name, CLI::AppFormatMode) const override;
};

/// The footer of a command's help: "Examples:" and each line prefixed with "glint ".
std::string examples(std::initializer_list<const char*> lines);

/// What is wrong with the command line, in one line. An unknown option or command comes first, with
/// the nearest known name, even if something else is missing too.
std::string usageMessage(const CLI::App&, const CLI::ParseError&, int argc, char** argv);

}  // namespace glint
