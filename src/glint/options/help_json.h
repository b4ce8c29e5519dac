#pragma once

#include <string>

namespace CLI {
class App;
}

namespace glint {

/// What a program's help says, for programs that make manual pages, completions and the reference
/// of options of it (cmake/manual.py):
///
///     {"name", "description", "footer", "arguments": [...], "options": [...], "commands": [...]}
///     an argument or option: {"names": ["-o", "--output"], "value", "help", "section",
///                             "required", "many", "look", "choices": [words that it may be]}
///
/// `value` is what stands for the value in help, empty for a flag; `look` tells the options of a
/// look, which several commands share; a command is as the program itself, without commands.
std::string helpJson(const CLI::App& app);

}  // namespace glint
