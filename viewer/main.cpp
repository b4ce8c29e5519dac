#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "app.h"
#include "glint/options/exit_status.h"
#include "glint/options/heap.h"
#include "glint/options/help.h"
#include "glint/options/look_options.h"
#include "glint/options/process.h"

int main(int argc, char** argv) {
  glint::prepareProcess();
  glint::adviseHeap();
  CLI::App app(
      "glint-viewer shows a model in a window: edit materials, lights and camera, compare two\n"
      "looks, see the lobe and the Fresnel curve; what is shown is what glint render draws.",
      "glint view");
  app.formatter(std::make_shared<glint::HelpFormatter>());
  glint::viewer::AppOptions options;
  std::string model, glsl;
  app.add_option("MODEL", model,
                 "a glTF 2.0 model, .gltf or .glb; one can be dropped on the window");
  app.add_option("--glsl", glsl,
                 "take shader files from this folder where it has them; changes show at once")
      ->type_name("DIR");
  app.add_option("--scale", options.scale,
                 "size of text and widgets; that of the screen unless given")
      ->type_name("FACTOR")
      ->check(CLI::Range(0.5, 4.0));
  const auto makeLook = glint::addLookOptions(app);
  const auto run = [&]() -> int {
    options.model = model;
    options.glsl = glsl;
    if (const CLI::Option* look = app.get_option("--look"); look->count() > 0)
      options.look = look->as<std::string>();
    const glint::Look look = makeLook();
    options.settings = glint::viewer::loadSettings();
    glint::viewer::Window window("glint", options.settings.window);
    glint::viewer::App viewer(window, look, options);
    viewer.run();
    return glint::done;
  };
  return glint::runProgram(app, argc, argv, run, "model or window");
}
