#include "glint/options/exit_status.h"

#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>
#include <new>

#include "glint/gl/context.h"
#include "glint/image/error.h"
#include "glint/image/file.h"
#include "glint/options/help.h"
#include "glint/options/outputs.h"

namespace glint {

namespace {

/// The body's status, or 0 after --help and --version.
int parseAndRun(CLI::App& app, int argc, char** argv, const std::function<int()>& body) {
  try {
    app.parse(argc, argv);
    return body();
  } catch (const CLI::Success& success) {
    return app.exit(success);
  }
}

}  // namespace

int runProgram(CLI::App& app, int argc, char** argv, const std::function<int()>& body,
               const char* smaller) {
  try {
    const int status = parseAndRun(app, argc, argv, body);
    flushStandardOutput();
    return status;
  } catch (const CLI::ParseError& error) {
    const std::string message = usageMessage(app, error, argc, argv);
    std::cerr << "glint: " << printablePath(message) << "\n";
    return unusable;
  } catch (const InputError& error) {  // may quote what was given, line breaks and all
    std::cerr << "glint: " << printablePath(error.what()) << "\n";
    return unusable;
  } catch (const ContextError& error) {
    std::cerr << "glint: " << error.what() << "\n";
    return noContext;
  } catch (const Error& error) {
    std::cerr << "glint: " << error.what() << "\n";
    return unusable;
  } catch (const std::bad_alloc&) {
    std::cerr << "glint: out of memory: give a smaller " << smaller << "\n";
    return unusable;
  } catch (const std::exception& error) {
    std::cerr << "glint: internal error: " << error.what() << ": please report this\n";
    return unusable;
  }
}

}  // namespace glint
