#include <memory>
#include <string>

#include "app.h"
#include "glint/options/add_option.h"
#include "glint/options/exit_status.h"
#include "glint/options/heap.h"
#include "glint/options/help.h"
#include "glint/options/look_options.h"
#include "glint/options/process.h"
#include "glint/options/read_options.h"

int main(int argc, char** argv) {
  glint::prepareProcess();
  glint::adviseHeap();
  CLI::App app(
      "shows a model in a window: edit materials, lights and camera, compare two looks, plot the "
      "specular lobe and the Fresnel curve. The window shows the picture that glint render writes.",
      "glint view");
  app.set_help_flag("-h,--help", "print this help and exit");
  app.formatter(std::make_shared<glint::HelpFormatter>());
  app.footer(glint::examples({"view helmet.glb", "view helmet.glb --look a.json",
                              "view helmet.glb --shading environment --environment sky"}));
  glint::viewer::AppOptions options;
  std::string model, glsl;
  app.add_option("MODEL", model,
                 "a glTF 2.0 model, .gltf or .glb; models can also be dropped on the window");
  glint::addOption(
      app, "--glsl", glsl, "DIR",
      "use the shader files in this folder instead of the built-in ones; changes to them are "
      "shown at once");
  glint::addNumber(app, "--scale", options.scale, "FACTOR", 0.5, 4.0,
                   "size of text and widgets, 0.5 to 4 [default: the screen's]");
  glint::addConfineOption(app);
  glint::addDecodeLimitOption(app);
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
