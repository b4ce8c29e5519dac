// scene_from_arrays PICTURE: a wave computed in the program, without a model file.

#include <cmath>
#include <cstdio>

#include "glint/compare.h"
#include "glint/glint.h"

namespace {

// A surface y = f(x, z) over the square from -1 to 1, with its exact normals, in copper.
glint::Arrays wave(int cells) {
  glint::Arrays arrays;
  for (int row = 0; row <= cells; ++row)
    for (int column = 0; column <= cells; ++column) {
      const float x = 2.0f * float(column) / float(cells) - 1;
      const float z = 2.0f * float(row) / float(cells) - 1;
      arrays.positions.push_back({x, 0.2f * std::sin(6 * x) * std::cos(4 * z), z});
      const float dx = 1.2f * std::cos(6 * x) * std::cos(4 * z);
      const float dz = -0.8f * std::sin(6 * x) * std::sin(4 * z);
      arrays.normals.push_back({-dx, 1, -dz});
      if (row == cells || column == cells) continue;
      // Counter-clockwise from above.
      const auto corner = std::uint32_t(row * (cells + 1) + column);
      const auto below = corner + std::uint32_t(cells + 1);
      arrays.indices.insert(arrays.indices.end(),
                            {corner, below, below + 1, corner, below + 1, corner + 1});
    }
  // The highlight has the metal's colour.
  arrays.material = "color=0.8,0.4,0.2,specular=0.6,exponent=40,metalness=1";
  arrays.twoSided = true;
  return arrays;
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 2) {
    std::fprintf(stderr, "scene_from_arrays PICTURE\n");
    return 2;
  }
  const glint::Arrays copper = wave(64);
  const glint::Model model = glint::Model::fromArrays({&copper, 1});
  glint::Session session;
  glint::writePicture(
      argv[1], session.draw(model, {{"resolution", "320,240"}, {"light", "directional:-1,2,1"}}));
} catch (const glint::Error& error) {
  std::fprintf(stderr, "scene_from_arrays: %s\n", error.what());
  return 1;
}
