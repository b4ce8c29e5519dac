// The lobe from a table: in GLSL it equals that in double, in pictures and in the terms of each
// light.

#include <gtest/gtest.h>

#include <cmath>

#include "glint/reference/renderer.h"
#include "glint/reference/terms.h"
#include "glint/render/picture_terms.h"
#include "glint/scene/look_text.h"
#include "glint/shading/bounds.h"
#include "stage.h"

namespace glint::test {
namespace lobe_table_gl_test {

class LobeTable : public OnStage {};

Look lit(Shading shading) {
  Look look = parallelLook({0.2, 0.3, 1}, 48);
  look.shading = shading;
  look.light = {directional({0.3, 0.4, 1}, {1, 0.9, 0.8}),
                directional({-1, 0.3, 0.2}, {0.3, 0.4, 0.5}),
                directional({0.5, -1, 0.6}, {0.2, 0.2, 0.1})};
  look.noBackground = true;
  return look;
}

/// Pixels inside the sphere, excluding those at its edge, that are off by more than the tolerance.
int pixelsOff(const Image& drawn, const Image& truth, double tolerance) {
  int off = 0;
  for (int y = 0; y < truth.height; ++y)
    for (int x = 0; x < truth.width; ++x) {
      const glm::dvec3 d = glm::abs(color(drawn, x, y) - color(truth, x, y));
      off += !(std::max({d.x, d.y, d.z}) <= tolerance);
    }
  return off;
}

// Compared with the same form in double. The tolerance is its rounding and the driver's
// interpolation of normals (1e-6, times the steepest slope 0.61 sqrt(a)); at edges, in a
// few of some 1000 pixels, the driver may choose the adjacent triangle.
TEST_P(LobeTable, IsThatInDouble) {
  for (const Shading shading : {Shading::phong, Shading::blinnPhong, Shading::gouraud})
    for (const int steps : {16, 64, 1024})
      for (const double exponent : {0.3, 1.0, 2.5, 20.0, 300.0}) {
        const Scene scene = sceneOf(sphere(48, 24), materialOf(0, 0, 0.5, exponent));
        Look look = lit(shading);
        look.highlight = {Highlight::table, steps};
        const bool blinn = usesBlinn(shading);
        const double n = blinn ? 4 * exponent : exponent;
        const double tolerance =
            0.5 * 1.5 * (lobeRoundingBound(Highlight::table, steps, n, blinn) + 1e-6 * (1 + n));
        const Image truth = ReferenceRenderer(scene, {}, boundsOf(scene), look).draw();
        EXPECT_LE(pixelsOff(draw(scene, look), truth, tolerance), 20)
            << shadingName(shading) << " " << steps << " " << exponent;
        // As far from the exact form as its bound allows, and no farther.
        look.highlight = Highlight::exact;
        const Image exact = ReferenceRenderer(scene, {}, boundsOf(scene), look).draw();
        EXPECT_LE(largestDifference(truth, exact),
                  0.5 * 1.5 * lobeFormulaBound(Highlight::table, steps, n) + 1e-6);
        if (tableBound(n, steps) > 0.1) {
          EXPECT_GT(largestDifference(truth, exact), 0.001);
        }
      }
}

// Each form uses its own table, in the picture and where one light is drawn separately.
TEST_P(LobeTable, EachFormHasItsOwn) {
  const Scene scene = sceneOf(sphere(48, 24), materialOf(0, 0.3, 0.5, 7.5));
  Look look = lit(Shading::phong);
  look.highlight = parseHighlights("table:16/1,exact/1,table:64", "--highlight");
  const Image truth = ReferenceRenderer(scene, {}, boundsOf(scene), look).draw();
  EXPECT_LE(pixelsOff(draw(scene, look), truth, 2e-5), 20);
  GpuScene gpu(scene, {});
  const Bounds bounds = boundsOf(scene);
  for (const PictureTerm& term : termsOf(makeDrawList(scene, bounds, look), look)) {
    if (term.kind != PictureTerm::Kind::specular) continue;
    const Image own = drawTerm(stage().renderer(), gpu, bounds, look, term);
    const Image of = drawReferenceTerm(scene, {}, bounds, look, term);
    EXPECT_LE(pixelsOff(own, of, 2e-5), 20) << term.name;
    EXPECT_GT(coveredPixels(own), 100u) << term.name;
  }
}

// With a varying exponent there is no single table.
TEST_P(LobeTable, OfAVaryingExponentIsExact) {
  const Scene scene = sceneOf(sphere(24, 12), materialOf(0, 0, 0.5, 20));
  Look look = lit(Shading::phong);
  look.specularAntialiasing = SpecularAntialiasing::kaplanyan;
  const Image exact = draw(scene, look);
  look.highlight = {Highlight::table, 64};
  EXPECT_EQ(draw(scene, look).values, exact.values);
}

INSTANTIATE_TEST_SUITE_P(Software, LobeTable, softwareBackends(), nameOfBackend);

}  // namespace lobe_table_gl_test
}  // namespace glint::test
