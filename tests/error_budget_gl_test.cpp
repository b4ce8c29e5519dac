// --max-error on the driver: the shading of pictures in the chosen forms, compared with the exact
// reference given the driver's own interpolated positions and normals.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>

#include "glint/budget/error_budget.h"
#include "glint/gl/context.h"
#include "glint/options/parameters.h"
#include "glint/reference/renderer.h"
#include "glint/render/renderer.h"
#include "glint/shading/bounds.h"
#include "random.h"
#include "scenes.h"

namespace glint {
namespace error_budget_gl_test {

class BudgetOnDriver : public testing::TestWithParam<Backend> {};

using test::Random;

glm::dvec3 at(const Image& image, int x, int y) {
  const float* p = image.row(y) + 4 * x;
  return {p[0], p[1], p[2]};
}

// A directional light, a lamp, or a spot whose ramp crosses the sphere.
Light lightAround(Random& r, bool fallsOff) {
  Light light = test::directional(r.direction(), r.color());
  const int kind = r.below(4);
  if (kind < 2) return light;
  light.type = kind == 2 ? Light::Type::point : Light::Type::spot;
  light.position = r.log(2, 50) * light.direction;
  light.direction = -light.position;
  light.outerAngle = 10 + 70 * r.unit();
  light.innerAngle = 0.8 * r.unit() * light.outerAngle;
  light.fallsOff = fallsOff;
  if (light.fallsOff) light.intensity *= glm::dot(light.position, light.position);
  return light;
}

TEST_P(BudgetOnDriver, ShadingKeepsWithinIt) {
  const auto context = openContext(GetParam());
  context->makeCurrent();
  Renderer renderer;
  Random r(31);
  const int draws = test::drawsOf("GLINT_BUDGET_DRAWS", 12);
  int pixels = 0, approximate = 0, behind = 0;
  double nearest = 0;
  for (int i = 0; i < draws; ++i) {
    Material m = test::materialOf(r.unit(), r.unit(), r.log(0.05, 1.5), r.log(1, 2000),
                                  r.coin() ? 0 : r.unit(), r.color());
    if (r.coin()) m.shading.exponent = std::round(m.shading.exponent);
    m.shading.ior = 1.1 + 2 * r.unit();
    // Some are glass, seen from inside.
    const bool within = i % 4 == 2 && r.coin();
    m.doubleSided = within;
    if (r.below(3) == 0) m.shading.transmission = r.unit();
    Scene scene = test::sceneOf(test::sphere(24, 12), m);
    Look look;
    constexpr Shading programs[] = {Shading::phong, Shading::blinnPhong, Shading::environment,
                                    Shading::automatic};
    look.shading = programs[i % 4];
    const Shading truth = i % 4 == 3 ? Shading::phong : look.shading;
    look.maxError = r.log(2e-5, 0.3);
    if (i % 6 == 5) {  // rounding only, also without a highlight
      look.maxError = 0;
      if (r.coin()) scene.materials[0].shading.specular = 0;
    }
    look.light.emplace();
    const bool many = i % 4 != 3 && r.coin();  // some of which are dim
    const bool fallsOff = r.below(3) == 0;     // all of a file's lights do, none of --light
    for (int k = r.below(many ? 24 : 3); k >= 0; --k) {
      look.light->push_back(lightAround(r, fallsOff));
      if (many) look.light->back().intensity *= r.log(1e-4, 1);
    }
    if (r.below(3) == 0)
      look.normalization = r.coin() ? Normalization::simple : Normalization::exact;
    look.specularAntialiasing = SpecularAntialiasing(std::max(r.below(5) - 2, 0));
    look.viewer = r.coin() ? Viewer::infinite : Viewer::local;
    look.environment = Environment(r.below(3));
    if (within) look.cameraPosition = 0.7 * r.direction();
    look.resolution = {32, 32};
    look.antiAliasing = {AntiAliasing::Mode::none, 1};
    look.noBackground = true;
    const Bounds bounds = boundsOf(scene);
    const ResolvedLook resolved = resolveLook(scene, bounds, look);
    approximate += resolved.look.highlight != HighlightForm(Highlight::exact);
    Look exact = resolved.look;
    exact.shading = truth;
    exact.highlight = Highlight::exact;
    exact.fresnel = Fresnel::exact;
    const ReferenceRenderer reference(scene, {}, bounds, exact, 1);
    const auto attributes = reference.attributes(0, 32);
    GpuScene gpu(scene, {});
    const Image drawn =
        renderer.draw(gpu, makeDrawList(scene, bounds, resolved.look), resolved.look);
    const DrawList geometry = makeDrawList(scene, bounds, exact);
    const auto attribute = [&](PixelOutput output) {
      DrawList list = geometry;
      for (DrawItem& item : list.items) item.variant = attributeVariant(item.variant, output);
      return renderer.draw(gpu, std::move(list), exact);
    };
    const Image positions = attribute(PixelOutput::position);
    const Image normals = attribute(PixelOutput::normal);
    for (int y = 0; y < 32; ++y)
      for (int x = 0; x < 32; ++x) {
        reference::Attributes a = attributes[std::size_t(32 * y + x)];
        if (a.item < 0 || drawn.row(y)[4 * x + 3] == 0) continue;
        a.position = at(positions, x, y);
        a.normal = at(normals, x, y);
        // Filtered by the triangle's normals; near an edge the driver may use the adjacent
        // triangle's.
        if (look.specularAntialiasing == SpecularAntialiasing::kaplanyan &&
            a.edgeDistance < 1.0 / 128)
          continue;
        // Where N.L rounds to either side of 0 the model itself jumps.
        const glm::dvec3 n = glm::normalize(a.normal);
        bool jumps = false;
        for (const reference::Light& light : reference.stage().frame.lights)
          jumps =
              jumps || std::abs(glm::dot(n, light.type == reference::Light::Type::directional
                                                ? light.place
                                                : glm::normalize(light.place - a.position))) < 2e-6;
        if (!a.front) {
          const double c = glm::dot(-n, reference::toViewer(reference.stage().frame, a.position));
          const double off = c - criticalCosine(m.shading.ior, 1);
          jumps = jumps || std::abs(off) < criticalRing(m.shading.ior, 1);
          ++behind;
        }
        if (jumps) continue;
        const glm::dvec3 difference = glm::abs(at(drawn, x, y) - reference.shade(a).radiance);
        const double error = std::max({difference.x, difference.y, difference.z});
        ++pixels;
        nearest = std::max(nearest, error / resolved.bound);
        ASSERT_LE(error, resolved.bound)
            << saveLook(look) << saveLook(resolved.look) << x << "," << y;
        if (resolved.bound <= *look.maxError) {
          ASSERT_LE(error, *look.maxError);
        }
      }
  }
  std::printf(
      "%d pixels, %d of back faces, of %d pictures, %d of them in another form than exact; at most "
      "%.3f of the bound\n",
      pixels, behind, draws, approximate, nearest);
  EXPECT_GT(pixels, 100 * draws);
  EXPECT_GT(approximate, draws / 4);
  if (draws > 30) {
    EXPECT_GT(behind, 10 * draws);
  }
}

INSTANTIATE_TEST_SUITE_P(Software, BudgetOnDriver, testing::Values(Backend::osmesa),
                         [](const auto&) { return "osmesa"; });

}  // namespace error_budget_gl_test
}  // namespace glint
