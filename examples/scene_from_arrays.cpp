// scene_from_arrays PICTURE: a wave made of numbers, without a model file.

#include <cmath>
#include <cstdio>

#include "glint/gl/context.h"
#include "glint/image/picture_writer.h"
#include "glint/render/renderer.h"

namespace {

// A surface y = f(x, z) over the square from -1 to 1, with its exact normals.
glint::Mesh wave(int cells) {
  glint::Mesh mesh;
  for (int row = 0; row <= cells; ++row)
    for (int column = 0; column <= cells; ++column) {
      const float x = 2.0f * float(column) / float(cells) - 1;
      const float z = 2.0f * float(row) / float(cells) - 1;
      mesh.positions.push_back({x, 0.2f * std::sin(6 * x) * std::cos(4 * z), z});
      const float dx = 1.2f * std::cos(6 * x) * std::cos(4 * z);
      const float dz = -0.8f * std::sin(6 * x) * std::sin(4 * z);
      mesh.normals.push_back(glm::normalize(glm::vec3(-dx, 1, -dz)));
      if (row == cells || column == cells) continue;
      // Counter-clockwise from above.
      const auto corner = std::uint32_t(row * (cells + 1) + column);
      const auto below = corner + std::uint32_t(cells + 1);
      mesh.indices.insert(mesh.indices.end(),
                          {corner, below, below + 1, corner, below + 1, corner + 1});
    }
  return mesh;
}

glint::Scene waveScene() {
  glint::Material copper;
  copper.name = "copper";
  copper.doubleSided = true;
  copper.shading.color = {0.8, 0.4, 0.2};  // linear
  copper.shading.specular = 0.6;
  copper.shading.exponent = 40;
  copper.shading.metalness = 1;  // the highlight has the metal's colour

  glint::Scene scene;
  scene.materials = {copper};
  scene.meshes = {wave(64)};
  scene.instances = {{.mesh = 0, .world = glm::dmat4(1.0)}};
  return scene;
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 2) {
    std::fprintf(stderr, "scene_from_arrays PICTURE\n");
    return 2;
  }
  const glint::Scene scene = waveScene();
  glint::Look look;
  look.resolution = {320, 240};
  glint::Light sun;
  sun.direction = {-1, 2, 1};  // to the light
  look.light = {{sun}};

  const auto context = glint::openContext(glint::Backend::automatic);
  context->makeCurrent();
  glint::Renderer renderer;
  glint::GpuScene uploaded(scene, {});  // no textures
  const auto writer = glint::openPictureWriter(argv[1], look.resolution.x, look.resolution.y);
  writer->write(renderer.draw(uploaded, glint::boundsOf(scene), look));
  writer->finish();
} catch (const glint::Error& error) {
  std::fprintf(stderr, "scene_from_arrays: %s\n", error.what());
  return 1;
}
