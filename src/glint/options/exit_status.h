#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace glint {

/// Status codes of the program, for scripts.
enum ExitStatus : int { done = 0, differs = 1, unusable = 2, noContext = 3, noBaseline = 4 };

/// Runs a program to its exit status: parses the command line with `app`, then runs `body`. What is
/// thrown is told in one line on stderr; for want of memory `smaller` says what to make smaller.
int runProgram(CLI::App& app, int argc, char** argv, const std::function<int()>& body,
               const char* smaller);

}  // namespace glint
