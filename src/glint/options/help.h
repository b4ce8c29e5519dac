#pragma once

#include <CLI/CLI.hpp>
#include <initializer_list>
#include <string>

namespace glint {

/// Help within 80 columns: an option with its value on one line, what it does below, wrapped;
/// sections apart by one empty line; the footer, where a command's examples are, last.
class HelpFormatter : public CLI::FormatterBase {
 public:
  std::string make_help(const CLI::App*, std::string name, CLI::AppFormatMode) const override;
};

/// The footer of a command's help: "Examples:" and each line behind "glint ".
std::string examples(std::initializer_list<const char*> lines);

/// What is wrong with the command line, in one line: of an unknown option or command first, with
/// the nearest known one, even where something else is missing, too.
std::string usageMessage(const CLI::App&, const CLI::ParseError&, int argc, char** argv);

}  // namespace glint
