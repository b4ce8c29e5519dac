#include "exit_status.h"

#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>
#include <new>

#include "commands.h"
#include "glint/gl/context.h"
#include "glint/image/error.h"
#include "help.h"

namespace glint {

int runProgram(CLI::App& app, int argc, char** argv, const std::function<int()>& body,
               const char* smaller) {
  try {
    app.parse(argc, argv);
    return body();
  } catch (const CLI::Success& success) {  // --help, --version
    return app.exit(success);
  } catch (const CLI::ParseError& error) {
    std::cerr << "glint: " << usageMessage(app, error, argc, argv) << "\n";
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
