// render_to_memory MODEL: draws a model into memory and counts the pixels that it covers.

#include <cstdio>

#include "glint/budget/error_budget.h"
#include "glint/gl/context.h"
#include "glint/gltf/scene_file.h"
#include "glint/render/renderer.h"

int main(int argc, char** argv) try {
  if (argc != 2) {
    std::fprintf(stderr, "render_to_memory MODEL\n");
    return 2;
  }
  glint::Scene scene = glint::loadGltf(argv[1]);
  const glint::Bounds bounds = glint::boundsOf(scene);

  glint::Look look;  // as `glint render` without options, but for these
  look.resolution = {256, 256};
  look.shading = glint::Shading::blinnPhong;
  look.noBackground = true;
  look.maxError = 0.001;  // of linear light: the cheapest formulas that keep within it
  const glint::ResolvedLook resolved = glint::resolveLook(scene, bounds, look);

  // First the context: what lives in it dies before it.
  const auto context = glint::openContext(glint::Backend::automatic);
  context->makeCurrent();
  glint::Renderer renderer;  // keeps its shaders from picture to picture
  glint::GpuScene uploaded(scene, glint::decodeImages(scene, resolved.look));
  const glint::Image picture = renderer.draw(uploaded, bounds, resolved.look);

  int covered = 0;
  for (std::size_t i = 3; i < picture.values.size(); i += 4) covered += picture.values[i] > 0;
  std::printf("%s: %d of %d pixels, error at most %.2g\n", glint::glStrings().renderer.c_str(),
              covered, picture.width * picture.height, resolved.bound);
} catch (const glint::Error& error) {
  std::fprintf(stderr, "render_to_memory: %s\n", error.what());
  return 1;
}
