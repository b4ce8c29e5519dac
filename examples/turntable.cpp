// turntable MODEL COUNT NAME: NAME-0.png and so on, the model seen from all around.

#include <cstdio>
#include <cstdlib>
#include <string>

#include "glint/gl/context.h"
#include "glint/gltf/scene_file.h"
#include "glint/image/picture_writer.h"
#include "glint/render/renderer.h"

int main(int argc, char** argv) try {
  const int count = argc == 4 ? std::atoi(argv[2]) : 0;
  if (count < 1) {
    std::fprintf(stderr, "turntable MODEL COUNT NAME\n");
    return 2;
  }
  glint::Scene scene = glint::loadGltf(argv[1]);
  const glint::Bounds bounds = glint::boundsOf(scene);
  glint::Look look;
  look.resolution = {192, 192};

  const auto context = glint::openContext(glint::Backend::automatic);
  context->makeCurrent();
  glint::Renderer renderer;
  glint::GpuScene uploaded(scene, glint::decodeImages(scene, look));  // once, for all pictures
  for (int i = 0; i < count; ++i) {
    const std::string path = argv[3] + ("-" + std::to_string(i)) + ".png";
    const glint::Look turned = glint::turnedLook(look, scene, bounds, 360.0 * i / count);
    const auto writer = glint::openPictureWriter(path, look.resolution.x, look.resolution.y);
    writer->write(renderer.draw(uploaded, bounds, turned));
    writer->finish();  // only now is there a file
    std::printf("%s\n", path.c_str());
  }
} catch (const glint::Error& error) {
  std::fprintf(stderr, "turntable: %s\n", error.what());
  return 1;
}
