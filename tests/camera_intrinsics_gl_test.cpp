// A lens with an off-centre axis shows a part of the picture of a larger sensor with a centred
// axis: shapes, reflections, refractions and the environment background.

#include <gtest/gtest.h>

#include "glint/reference/renderer.h"
#include "stage.h"

namespace glint::test::camera_intrinsics_gl_test {

constexpr int left = 37, top = 11, width = 80, height = 60;  // the part, of 160 x 120

class Intrinsics : public OnStage {
 protected:
  Image drawn(const Scene& scene, const Look& look, bool reference) {
    if (!reference) return draw(scene, look);
    return glint::ReferenceRenderer(scene, {}, boundsOf(scene), look).draw();
  }
};

TEST_P(Intrinsics, SeeAPartOfALargerPicture) {
  glint::Material glass = materialOf(1, 0.7, 0.5, 40, 0, {0.9, 0.5, 0.3});
  glass.shading.transmission = 0.6;
  const Scene scene = sceneOf(sphere(64, 32), glass);
  Look whole;
  whole.shading = glint::Shading::environment;
  whole.environmentBackground = true;
  whole.cameraPosition = glm::dvec3(0.5, 0.4, 3);
  whole.resolution = {160, 120};
  whole.cameraIntrinsics = glm::dvec4(130, 150, 80, 60);
  whole.antiAliasing = {glint::AntiAliasing::Mode::none, 1};
  Look part = whole;
  part.resolution = {width, height};
  part.cameraIntrinsics = glm::dvec4(130, 150, 80 - left, 60 - top);
  for (const bool reference : {false, true}) {
    const Image large = drawn(scene, whole, reference), small = drawn(scene, part, reference);
    int differing = 0;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const glm::dvec4 d = glm::abs(pixel(small, x, y) - pixel(large, x + left, y + top));
        // Positions are rounded in clip space, by 2^-24 of the picture: 1e-5 pixels, which turns
        // directions by less than 1e-7; the studio's lights have slopes of some hundreds.
        differing += std::max({d.x, d.y, d.z, d.w}) > 1e-4;
      }
    // Where an edge passes through a pixel's centre, rounding decides.
    EXPECT_LE(differing, 8) << (reference ? "reference" : "GL");
    EXPECT_GT(largestDifference(small, drawn(
                                           scene,
                                           [&] {
                                             Look moved = part;
                                             moved.cameraIntrinsics->z += 1;
                                             return moved;
                                           }(),
                                           reference)),
              0.01);
  }
}

INSTANTIATE_TEST_SUITE_P(Render, Intrinsics, softwareBackends(), nameOfBackend);

}  // namespace glint::test::camera_intrinsics_gl_test
