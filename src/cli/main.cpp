#include <CLI/CLI.hpp>
#include <array>
#include <cstdio>
#include <memory>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "commands.h"
#include "glint/options/exit_status.h"
#include "glint/options/heap.h"
#include "glint/options/help.h"
#include "glint/options/process.h"
#include "shorthand.h"

namespace {

constexpr const char* description =
    "glint draws glTF 2.0 models with the classic shading models, in a window or offscreen "
    "without a GPU or a display, compares pictures, and measures how fast and how exact each way "
    "of shading is.\nglint help COMMAND lists a command's options; glint MODEL is short for "
    "glint view MODEL.";

// In the order of the help.
constexpr std::array<std::pair<std::string_view, glint::Command (*)(CLI::App&)>, 9> commands{
    {{"render", glint::addRender},
     {"view", glint::addView},
     {"diff", glint::addDiff},
     {"study", glint::addStudy},
     {"stability", glint::addStability},
     {"convert", glint::addConvert},
     {"info", glint::addInfo},
     {"environment", glint::addEnvironment},
     {"backends", glint::addBackends}}};

int runCommand(int argc, char** argv) {
  glint::adviseHeap();
  CLI::App app(description, "glint");
  app.set_version_flag("-V,--version", "glint " GLINT_VERSION, "print the version and exit");
  app.set_help_flag("-h,--help", "print this help and exit");
  app.require_subcommand(1);
  app.formatter(std::make_shared<glint::HelpFormatter>());
  app.footer(glint::examples({"render helmet.glb -o helmet.png",
                              "render *.glb -o 'thumbs/{model}.png' --resolution 256,256",
                              "diff baseline.png helmet.png --metric flip --threshold 0.05",
                              "helmet.glb"}));
  std::vector<std::string_view> names;
  std::vector<glint::Command> actions;
  for (const auto& [name, add] : commands) {
    names.push_back(name);
    actions.push_back(add(app));
  }
  const auto run = [&]() -> int {
    for (std::size_t i = 0; i < names.size(); ++i)
      if (app.got_subcommand(std::string(names[i]))) return actions[i]();
    return glint::unusable;
  };
  std::vector<std::string> words =
      glint::expandShorthand({argv + std::min(argc, 1), argv + argc}, names);
  std::vector<char*> arguments{argv[0]};
  for (std::string& word : words) arguments.push_back(word.data());
  return glint::runProgram(app, int(arguments.size()), arguments.data(), run,
                           "--resolution or model");
}

}  // namespace

int main(int argc, char** argv) {
  glint::prepareProcess();
  try {
    return runCommand(argc, argv);
  } catch (const std::bad_alloc&) {  // before there are options
    std::fputs("glint: out of memory: raise its limit (ulimit -v)\n", stderr);
    return glint::unusable;
  }
}
