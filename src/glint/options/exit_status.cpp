#include "glint/options/exit_status.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>
#include <span>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include "glint/gl/context.h"
#include "glint/image/error.h"
#include "glint/image/file.h"
#include "glint/options/help.h"
#include "glint/options/help_json.h"
#include "glint/options/outputs.h"

namespace glint {

namespace {

/// Throws InputError if an option of the command was given an empty value: mostly a shell variable
/// that is not set, where a check that was asked for must not be left out.
void refuseEmptyValues(const CLI::App& app) {
  for (const CLI::Option* option : app.get_options()) {
    const bool needsValue = option->get_items_expected_min() > 0;
    if (!needsValue || option->get_positional() || option->count() == 0) continue;
    const std::vector<std::string>& letters = option->get_snames();
    if (std::ranges::any_of(option->results(), &std::string::empty))
      throw InputError((letters.empty() ? option->get_name() : "-" + letters[0]) +
                       ": '' is empty: give " + option->get_type_name());
  }
  for (const CLI::App* command : app.get_subcommands()) refuseEmptyValues(*command);
}

/// The body's status, or 0 after --help, --help-json and --version.
int parseAndRun(CLI::App& app, int argc, char** argv, const std::function<int()>& body) {
  try {
    if (argc == 2 && std::string_view(argv[1]) == "--help-json") {
      std::cout << helpJson(app);
      return done;
    }
    // "--name=" would take the next word for its value.
    for (const std::string_view word : std::span(argv, std::size_t(argc)))
      if (word.starts_with("--") && word.find('=') == word.size() - 1)
        throw InputError(std::string(word.substr(0, word.size() - 1)) +
                         ": '' is empty: give a value");
    app.parse(argc, argv);
    refuseEmptyValues(app);
    return body();
  } catch (const CLI::Success& success) {
    return app.exit(success);
  }
}

}  // namespace

std::string failureOf(const std::exception& error, const std::string& what) {
  const std::string place = printablePath(what) + ": ";
  if (dynamic_cast<const Error*>(&error)) return error.what();
  if (dynamic_cast<const std::bad_alloc*>(&error) || dynamic_cast<const std::length_error*>(&error))
    return place + "out of memory: give a smaller model, picture or --resolution";
  if (const auto* file = dynamic_cast<const std::filesystem::filesystem_error*>(&error))
    return (file->path1().empty() ? place : printablePath(file->path1().string()) + ": ") +
           file->code().message() + ": check the path";
  if (dynamic_cast<const std::system_error*>(&error))
    return place + "the system refused another thread or file (" + error.what() +
           "): raise its limits (ulimit -u, ulimit -n)";
  return place + "internal error: " + error.what() + ": please report this";
}

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
  } catch (const InputError& error) {  // may quote input, including line breaks
    std::cerr << "glint: " << printablePath(error.what()) << "\n";
    return unusable;
  } catch (const ContextError& error) {
    std::cerr << "glint: " << printablePath(error.what()) << "\n";
    return noContext;
  } catch (const Error& error) {
    std::cerr << "glint: " << printablePath(error.what()) << "\n";
    return unusable;
  } catch (const std::bad_alloc&) {
    std::cerr << "glint: out of memory: give a smaller " << smaller << "\n";
    return unusable;
  } catch (const std::system_error& error) {  // mostly for lack of threads
    std::cerr << "glint: " << printablePath(failureOf(error, "glint")) << "\n";
    return unusable;
  } catch (const std::exception& error) {
    std::cerr << "glint: internal error: " << printablePath(error.what())
              << ": please report this\n";
    return unusable;
  }
}

}  // namespace glint
