#pragma once

#include <string>

namespace CLI {
class App;
}

namespace glint {

/// A program's help as data, for programs that generate manual pages, completions and the option
/// reference from it (cmake/manual.py):
///
///     {"name", "description", "footer", "arguments": [...], "options": [...], "commands": [...]}
///     an argument or option: {"names": ["-o", "--output"], "value", "help", "section",
///                             "required", "many", "look", "choices": [allowed words]}
///
/// `value` is the placeholder for the value in help, empty for a flag; `look` marks the options of
/// a look, which several commands share; a command has the same form as the program, without
/// commands.
std::string helpJson(const CLI::App& app);

}  // namespace glint
