#pragma once

#include <exception>
#include <functional>
#include <string>

namespace CLI {
class App;
}

namespace glint {

/// Status codes of the program, for scripts.
enum ExitStatus : int { done = 0, differs = 1, unusable = 2, noContext = 3, noBaseline = 4 };

/// The message of a failure while `what` (a path, or words) was made or read: an Error's own text;
/// "WHAT: out of memory: ..."; "WHAT: this system refuses ...".
std::string failureOf(const std::exception& error, const std::string& what);

/// Runs a program to its exit status: parses the command line with `app`, then runs `body`; the
/// option --help-json alone gives helpJson() of it. What is thrown becomes one line on stderr;
/// for want of memory `smaller` says what to make smaller.
int runProgram(CLI::App& app, int argc, char** argv, const std::function<int()>& body,
               const char* smaller);

}  // namespace glint
