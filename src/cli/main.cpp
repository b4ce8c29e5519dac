#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>

#include "commands.h"
#include "glint/gl/context.h"
#include "glint/image/error.h"
#include "heap.h"
#include "help.h"

namespace {

constexpr const char* description =
    "glint draws a model with the classic shading models, offscreen, on any machine.\n"
    "Models are glTF 2.0 files; `glint COMMAND --help` lists a command's options.";

int run(int argc, char** argv) {
  CLI::App app(description, "glint");
  app.set_version_flag("--version", "glint " GLINT_VERSION);
  app.require_subcommand(1);
  app.formatter(std::make_shared<glint::HelpFormatter>());
  std::pair<const char*, glint::Command> commands[] = {
      {"render", glint::addRender(app)},    {"view", glint::addView(app)},
      {"diff", glint::addDiff(app)},        {"study", glint::addStudy(app)},
      {"convert", glint::addConvert(app)},  {"info", glint::addInfo(app)},
      {"backends", glint::addBackends(app)}};
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& success) {  // --help, --version
    return app.exit(success);
  } catch (const CLI::ParseError& error) {
    std::cerr << "glint: " << glint::usageMessage(app, error, argc, argv) << "\n";
    return glint::unusable;
  }
  for (const auto& [name, command] : commands)
    if (app.got_subcommand(name)) return command();
  return glint::unusable;
}

}  // namespace

int main(int argc, char** argv) {
  glint::adviseHeap();
  try {
    return run(argc, argv);
  } catch (const glint::ContextError& error) {
    std::cerr << "glint: " << error.what() << "\n";
    return glint::noContext;
  } catch (const glint::Error& error) {
    std::cerr << "glint: " << error.what() << "\n";
    return glint::unusable;
  } catch (const std::bad_alloc&) {
    std::cerr << "glint: out of memory: give a smaller --resolution or model\n";
    return glint::unusable;
  } catch (const std::exception& error) {
    std::cerr << "glint: internal error: " << error.what() << ": please report this\n";
    return glint::unusable;
  }
}
