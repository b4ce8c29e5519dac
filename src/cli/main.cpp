#include <CLI/CLI.hpp>
#include <memory>
#include <utility>

#include "commands.h"
#include "glint/options/exit_status.h"
#include "glint/options/heap.h"
#include "glint/options/help.h"
#include "glint/options/process.h"

namespace {

constexpr const char* description =
    "glint draws a model with the classic shading models, offscreen, on any machine.\n"
    "Models are glTF 2.0 files; `glint COMMAND --help` lists a command's options.";

}  // namespace

int main(int argc, char** argv) {
  glint::prepareProcess();
  glint::adviseHeap();
  CLI::App app(description, "glint");
  app.set_version_flag("--version", "glint " GLINT_VERSION);
  app.require_subcommand(1);
  app.formatter(std::make_shared<glint::HelpFormatter>());
  std::pair<const char*, glint::Command> commands[] = {
      {"render", glint::addRender(app)},       {"view", glint::addView(app)},
      {"diff", glint::addDiff(app)},           {"study", glint::addStudy(app)},
      {"stability", glint::addStability(app)}, {"convert", glint::addConvert(app)},
      {"info", glint::addInfo(app)},           {"environment", glint::addEnvironment(app)},
      {"backends", glint::addBackends(app)}};
  const auto run = [&]() -> int {
    for (const auto& [name, command] : commands)
      if (app.got_subcommand(name)) return command();
    return glint::unusable;
  };
  return glint::runProgram(app, argc, argv, run, "--resolution or model");
}
