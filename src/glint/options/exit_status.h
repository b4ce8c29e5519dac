#pragma once

#include <exception>
#include <functional>
#include <string>

namespace CLI {
class App;
}

namespace glint {

/// The program's exit codes, for scripts.
enum ExitStatus : int { done = 0, differs = 1, unusable = 2, noContext = 3, noBaseline = 4 };

/// The message for a failure while making or reading `what` (a path, or words): an Error's own
/// text; "WHAT: out of memory: ..."; "WHAT: this system refuses ...".
std::string failureOf(const std::exception& error, const std::string& what);

/// Runs a program and returns its exit status: parses the command line with `app`, then runs
/// `body`; if --help-json is the only argument, prints helpJson() of `app` instead. Exceptions
/// become one line on stderr; if memory runs out, `smaller` names what to make smaller.
int runProgram(CLI::App& app, int argc, char** argv, const std::function<int()>& body,
               const char* smaller);

}  // namespace glint
