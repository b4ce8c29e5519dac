// The sum over the lights as drawn, compared with formulas in double: one surface in parallel
// projection, so that every pixel has the same N, L and V.

#include <gmock/gmock.h>

#include <vector>

#include "formulas.h"
#include "glint/scene/look_text.h"
#include "stage.h"
#include "variants.h"

namespace glint::test::render_sum_gl_test {

// A square that faces `toViewer`, with the normal `normal` at each corner.
Mesh facing(const glm::dvec3& toViewer, const glm::dvec3& normal) {
  const glm::dvec3 back = unit(toViewer);
  const glm::dvec3 right =
      unit(glm::cross(std::abs(back.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0), back));
  const glm::dvec3 up = glm::cross(back, right);
  Mesh mesh = quad(normal);
  for (glm::vec3& p : mesh.positions) p = glm::vec3(double(p.x) * right + double(p.y) * up);
  return mesh;
}

// Every program that shades with vertex normals; `environment` with an index of 1, which reflects
// nothing and so leaves its Blinn-Phong sum.
constexpr Shading withNormals[] = {Shading::gouraud, Shading::phong, Shading::blinnPhong,
                                   Shading::environment};

bool isBlinn(Shading s) { return s == Shading::blinnPhong || s == Shading::environment; }

class Sum : public OnStage {
 protected:
  // The single colour of a surface with these vectors.
  glm::dvec3 shadeOne(const Material& material, Look look, const glm::dvec3& n,
                      const glm::dvec3& v) {
    Material m = material;
    m.shading.ior = 1;
    const Look parallel = parallelLook(v, 3);
    look.cameraPosition = parallel.cameraPosition;
    look.cameraFocalPoint = parallel.cameraFocalPoint;
    look.cameraViewAngle = parallel.cameraViewAngle;
    look.resolution = parallel.resolution;
    const Image image = draw(sceneOf(facing(v, n), m), look);
    EXPECT_TRUE(isFinite(image));
    return middle(image);
  }
  static Look withLight(const glm::dvec3& l, Shading shading = Shading::phong) {
    Look look = parallelLook();
    look.light = {directional(l)};
    look.shading = shading;
    return look;
  }
};

struct Vectors {
  glm::dvec3 n, l, v;
  double diffuse, phong10, phong100, blinn40, blinn400;  // gated
};

// docs/science.md 8.4, from 40 digits.
const Vectors published[] = {
    {{0, 0, 1}, {1, 2, 2}, {-1, -2, 2}, 0.6666666667, 1, 1, 1, 1},
    {{0, 0, 1},
     {1, 2, 2},
     {0, 0, 1},
     0.6666666667,
     0.01734152992,
     2.459654427e-18,
     0.0260840533,
     1.457977395e-16},
    {{1, 1, 1},
     {1, 0, 0},
     {0, 1, 0},
     0.5773502692,
     0.01734152992,
     2.459654427e-18,
     0.0003007286598,
     6.0499e-36},
    {{1, 2, 3},
     {2, 1, 4},
     {0, 1, 1},
     0.9331389496,
     0.9223553807,
     0.4456386565,
     0.9136546485,
     0.4053411374},
    {{0, 0, 1},
     {3, 0, 4},
     {-3, 0.3, 4},
     0.8,
     0.9821927787,
     0.8355402348,
     0.9723262626,
     0.7553011789},
    {{0, 0, 1}, {1, 0, -0.1}, {-1, 0, 0.1}, 0, 0, 0, 0, 0},
};

TEST_P(Sum, GivesThePublishedVectors) {
  for (const Vectors& x : published)
    for (Shading shading : withNormals) {
      if (shading == Shading::gouraud) continue;  // its lobe is phong's: see below
      SCOPED_TRACE(testing::Message()
                   << glint::shadingName(shading) << " L " << x.l.x << "," << x.l.y << "," << x.l.z
                   << " V " << x.v.x << "," << x.v.y << "," << x.v.z);
      Look look = withLight(x.l, shading);
      // N.L of two vectors with 8 roundings each.
      const glm::dvec3 diffuse = shadeOne(materialOf(0, 1, 0, 1), look, x.n, x.v);
      expectColor(diffuse, glm::dvec3(x.diffuse), 16 * rounding + 1e-10, "diffuse");
      for (double exponent : {10.0, 100.0})
        for (auto form : {glint::Highlight::exact, glint::Highlight::pow}) {
          look.highlight = form;
          const double expected = isBlinn(shading) ? (exponent == 10 ? x.blinn40 : x.blinn400)
                                                   : (exponent == 10 ? x.phong10 : x.phong100);
          const double power = isBlinn(shading) ? 4 * exponent : exponent;
          // The textbook's form has an error proportional to the exponent, not to its root: x^a
          // with x off by 24 roundings (docs/science.md 2.5: about 5e-7 a).
          const double tolerance =
              form == glint::Highlight::exact ? lobeTolerance(power) : (24 * power + 16) * rounding;
          const glm::dvec3 lobe = shadeOne(materialOf(0, 0, 1, exponent), look, x.n, x.v);
          expectColor(lobe, glm::dvec3(expected), tolerance + 1e-10, "lobe");
        }
    }
}

TEST_P(Sum, GouraudShadesVerticesByPhong) {
  for (const Vectors& x : published) {
    Look look = withLight(x.l, Shading::gouraud);
    const glm::dvec3 seen = shadeOne(materialOf(0, 0.25, 0.5, 10), look, x.n, x.v);
    expectColor(seen, glm::dvec3(0.25 * x.diffuse + 0.5 * x.phong10), lobeTolerance(10));
  }
}

TEST_P(Sum, GivesRandomVectorsAndMaterials) {
  const SurfaceValues materials[] = {{0.3, 0.7, 0.4, 25, 0.5, {0.8, 0.5, 0.2}},
                                     {1, 1, 1, 3, 1, {0.1, 0.9, 0.4}},
                                     {0, 0.2, 1, 300, 0, {0.6, 0.6, 0.1}}};
  const glm::dvec3 ambient(0.1, 0.2, 0.3);
  const glm::dvec3 ns[] = {{0.2, 0.3, 1}, {-0.5, 0.1, 0.7}, {1, 1, 1}};
  const glm::dvec3 ls[] = {{0.5, 0.4, 1}, {-1, 2, 0.3}, {0.2, -0.9, 0.1}};
  const glm::dvec3 vs[] = {{0, 0, 1}, {0.4, -0.3, 0.8}};
  for (Shading shading : withNormals)
    for (const SurfaceValues& m : materials)
      for (const glm::dvec3& n : ns)
        for (const glm::dvec3& l : ls)
          for (const glm::dvec3& v : vs) {
            if (shading == Shading::environment && m.metalness > 0) continue;  // would be a mirror
            Look look = withLight(l, shading);
            look.ambientLight = ambient;
            const Material material =
                materialOf(m.ambient, m.diffuse, m.specular, m.exponent, m.metalness, m.color);
            const glm::dvec3 expected =
                shaded(m, ambient, unit(n), unit(l), unit(v), isBlinn(shading));
            const double exponent = isBlinn(shading) ? 4 * m.exponent : m.exponent;
            expectColor(shadeOne(material, look, n, v), expected,
                        lobeTolerance(exponent) + 24 * rounding,
                        glint::shadingName(shading).data());
          }
}

// E10, C2, C3, C10, D2: light from behind adds nothing for any exponent; exactly the ambient light.
TEST_P(Sum, LightFromBehindGivesExactlyTheAmbientLight) {
  const glm::dvec3 c(0.75, 0.5, 0.25), a(0.5, 0.25, 0.125);
  const glm::dvec3 behind[] = {{0, 0, -1}, {1, 0, -1e-3}, {1, 0, 0}, {0, -1, 0}, {0.3, 0.2, -0.1}};
  for (Shading shading : everyShading)
    for (const glm::dvec3& l : behind)
      for (double exponent : {0.0, 0.5, 5.0, 1e6}) {
        Look look = withLight(l, shading);
        look.ambientLight = a;
        const glm::dvec3 seen =
            shadeOne(materialOf(0.5, 1, 1, exponent, 0, c), look, {0, 0, 1}, {0, 0, 1});
        EXPECT_EQ(seen, 0.5 * a * c)  // binary fractions: exact in float too
            << glint::shadingName(shading) << " exponent " << exponent << " L.z " << l.z;
      }
}

// Where a smooth surface turns away from the light, the gate is exactly at N.L = 0.
TEST_P(Sum, GateIsAtTheTerminator) {
  for (Shading shading : withNormals) {
    Look look = withLight({0, 0, 1}, shading);
    const glm::dvec3 lit = shadeOne(materialOf(0, 1, 0, 1), look, {1, 0, 1e-3}, {1, 0, 1});
    expectColor(lit, glm::dvec3(1e-3), 16 * rounding);
    const glm::dvec3 unlit = shadeOne(materialOf(0, 1, 1, 0), look, {1, 0, -1e-3}, {1, 0, 1});
    EXPECT_EQ(unlit, glm::dvec3(0));
  }
}

// C1, C5: the peak is 1 and never more, for any exponent; D1: exponent 0 is 1 up to 90 degrees.
TEST_P(Sum, PeakIsOne) {
  for (Shading shading : withNormals)
    for (double exponent : {0.0, 1.0, 100.0, 1e4, 1e6}) {
      const Look look = withLight({0, 0, 1}, shading);
      const glm::dvec3 seen = shadeOne(materialOf(0, 0, 1, exponent), look, {0, 0, 1}, {0, 0, 1});
      EXPECT_EQ(seen, glm::dvec3(1)) << glint::shadingName(shading) << " " << exponent;
      const glm::dvec3 mirrored = shadeOne(materialOf(0, 0, 1, exponent),
                                           withLight({3, 1, 4}, shading), {0, 0, 1}, {-3, -1, 4});
      EXPECT_LE(mirrored.x, 1);
      EXPECT_GE(mirrored.x, 1 - lobeTolerance(isBlinn(shading) ? 4 * exponent : exponent));
    }
  EXPECT_EQ(shadeOne(materialOf(0, 0, 1, 0), withLight({1, 0, 1}), {0, 0, 1}, {1, 0, 2}).x, 1);
  // R.V < 0
  EXPECT_EQ(shadeOne(materialOf(0, 0, 1, 0), withLight({1, 0, 0.2}), {0, 0, 1}, {1, 0, 0.2}).x, 0);
  EXPECT_EQ(shadeOne(materialOf(0, 0, 1, 2.5), withLight({1, 0, 0.2}), {0, 0, 1}, {1, 0, 0.2}).x,
            0);
}

// C7, C8: the half vector of opposite L and V is undefined.
TEST_P(Sum, OpposedLightAndViewGiveNoHighlight) {
  for (Shading shading : {Shading::phong, Shading::blinnPhong, Shading::environment})
    for (double exponent : {0.0, 0.5, 20.0})
      for (const glm::dvec3& v : {glm::dvec3(1, 0, 0), glm::dvec3(1, 2, 3)})
        for (auto form : {glint::Highlight::exact, glint::Highlight::pow}) {
          Look look = withLight(-v, shading);
          look.highlight = form;
          EXPECT_EQ(shadeOne(materialOf(0, 0, 1, exponent), look, -v + glm::dvec3(0, 0, 1e-4), v),
                    glm::dvec3(0));
        }
}

// E9: S = m_sm C + (1 - m_sm).
TEST_P(Sum, MetalnessOneColoursTheHighlightAndZeroLeavesItWhite) {
  const glm::dvec3 c(0.75, 0.25, 0.125);
  for (Shading shading : withNormals) {
    const auto highlight = [&](double metalness, const glm::dvec3& color) {
      Material m = materialOf(0, 0, 0.5, 40, metalness, color);
      return shadeOne(m, withLight({0, 0, 1}, shading), {0, 0, 1}, {0, 0, 1});
    };
    if (shading != Shading::environment) {  // whose metals reflect the environment too
      EXPECT_EQ(highlight(1, c), 0.5 * c);
      EXPECT_EQ(highlight(0.5, c), 0.5 * (0.5 * c + 0.5));
      EXPECT_EQ(highlight(1, glm::dvec3(0)), glm::dvec3(0));  // F8
    }
    EXPECT_EQ(highlight(0, c), glm::dvec3(0.5));
    EXPECT_EQ(highlight(0, glm::dvec3(0)), glm::dvec3(0.5));  // F7
  }
}

TEST_P(Sum, WithoutLightsThereIsTheAmbientLightAlone) {  // F1, F4, F13
  for (Shading shading : everyShading) {
    Look look = withLight({0, 0, 1}, shading);
    look.ambientLight = {0.5, 0.25, 1};
    look.noLights = true;
    const Material m = materialOf(0.5, 1, 1, 10, 0, {0.5, 0.75, 1});
    const glm::dvec3 expected(0.125, 0.09375, 0.5);
    EXPECT_EQ(shadeOne(m, look, {0, 0, 1}, {0, 0, 1}), expected);
    look.noLights = false;
    look.light = {directional({0, 0, 1}, glm::dvec3(0))};
    EXPECT_EQ(shadeOne(m, look, {0, 0, 1}, {0, 0, 1}), expected);
    look.light = {directional({0, 0, 1})};
    EXPECT_EQ(shadeOne(materialOf(0, 0, 0, 10), look, {0, 0, 1}, {0, 0, 1}), glm::dvec3(0));
  }
}

TEST_P(Sum, ManyLightsAddUp) {  // F2, F10
  for (Shading shading : everyShading) {
    Look look = withLight({0.3, 0.4, 1}, shading);
    const Material m = materialOf(0, 0.5, 0.5, 20);
    const glm::dvec3 one = shadeOne(m, look, {0, 0, 1}, {0, 0, 1});
    look.light.emplace(64, directional({0.3, 0.4, 1}, glm::dvec3(1.0 / 64)));
    // 63 additions round by at most half an ulp of the sum each.
    expectColor(shadeOne(m, look, {0, 0, 1}, {0, 0, 1}), one, 64 * rounding);
    look.light.emplace(128, directional({0.3, 0.4, 1}));
    expectColor(shadeOne(m, look, {0, 0, 1}, {0, 0, 1}), 128.0 * one, 128 * 128 * rounding);
  }
}

TEST_P(Sum, ColouredLightsMultiplyComponentwise) {  // F12
  Look look = withLight({0, 0, 1});
  look.light = {directional({0, 0, 1}, {1, 0, 0.5})};
  const glm::dvec3 seen =
      shadeOne(materialOf(0, 1, 0, 1, 0, {0.5, 1, 0.5}), look, {0, 0, 1}, {0, 0, 1});
  EXPECT_EQ(seen, glm::dvec3(0.5, 0, 0.25));
}

TEST_P(Sum, HugeValuesStayFinite) {  // F5
  for (Shading shading : everyShading) {
    Look look = withLight({0, 0, 1}, shading);
    look.light = {directional({0, 0, 1}, glm::dvec3(1e6))};
    look.ambientLight = glm::dvec3(1e6);
    Material m = materialOf(1e6, 1e6, 1e6, 1e6, 0, glm::dvec3(1e6));
    const glm::dvec3 seen = shadeOne(m, look, {0, 0, 1}, {0, 0, 1});
    // m_a C A + m_d C I + m_s I
    EXPECT_NEAR(seen.x / (2e18 + 1e12), 1, 16 * rounding);
    m.shading.color = glm::dvec3(0);
    m.shading.specular = 0;
    EXPECT_EQ(shadeOne(m, look, {0, 0, 1}, {0, 0, 1}), glm::dvec3(0));
  }
}

TEST_P(Sum, PointLightsShineFromWhereTheyAre) {  // C11, C12
  for (Shading shading : withNormals) {
    Look look = withLight({0, 0, 1}, shading);
    Light point = lightOf(Light::Type::point);
    const Material m = materialOf(0, 1, 0, 1);
    const auto lit = [&](const glm::dvec3& position) {
      point.position = position;
      look.light = {point};
      return shadeOne(m, look, {0, 0, 1}, {0, 0, 1}).x;
    };
    if (shading != Shading::gouraud) {  // gouraud's vertices are elsewhere
      // The middle pixel is the origin, up to a few roundings of the eye's distance 4 (E = 2e-6).
      EXPECT_NEAR(lit({3, 0, 4}), 0.8, 2e-6);
      EXPECT_NEAR(lit({0, 0, 0.5}), 1, 2e-6);
    }
    EXPECT_NEAR(lit(glm::dvec3(3, 0, 4) * 1e30), 0.8, 2e-6);
    EXPECT_NEAR(lit(glm::dvec3(3, 0, 4) * 1e14), 0.8, 2e-6);
    EXPECT_EQ(lit({0.5, 0.25, -1e30}), 0);
    EXPECT_TRUE(std::isfinite(lit({0, 0, 0})));  // at the surface itself
  }
}

TEST_P(Sum, SpotsShineInACone) {
  Light spot = directional({0.3, 0.1, -1}, {1, 0.5, 0.25});
  spot.type = Light::Type::spot;
  spot.position = {-0.2, 0.1, 1.5};
  spot.innerAngle = 12;
  spot.outerAngle = 30;
  for (Shading shading : {Shading::phong, Shading::blinnPhong}) {
    Look look = parallelLook({0, 0, 1}, 33);
    look.shading = shading;
    look.light = {spot};
    const Image image = draw(sceneOf(quad(), materialOf(0, 1, 0, 1)), look);
    const double inner = std::cos(12 * degrees), outer = std::cos(30 * degrees);
    // The cosine is off by 16 roundings; the ramp's slope and the square magnify them.
    const double tolerance = 2 / (inner - outer) * 16 * rounding + 16 * rounding;
    int full = 0, none = 0, between = 0;
    for (int y = 0; y < 33; ++y)
      for (int x = 0; x < 33; ++x) {
        const glm::dvec3 p((x + 0.5) / 33 * 2 - 1, 1 - (y + 0.5) / 33 * 2, 0);
        const glm::dvec3 l = unit(spot.position - p);
        double cone = (glm::dot(-l, unit(spot.direction)) - outer) / (inner - outer);
        cone = std::clamp(cone, 0.0, 1.0);
        ++(cone == 0 ? none : cone == 1 ? full : between);
        expectColor(color(image, x, y), spot.intensity * (cone * cone * l.z), tolerance);
      }
    EXPECT_GT(full, 20);
    EXPECT_GT(none, 20);
    EXPECT_GT(between, 20);
  }
}

// V, L and H of each pixel in perspective with a nearby light; C16: one V for all pixels with an
// infinite viewer.
TEST_P(Sum, EachPixelHasItsOwnVectors) {
  const int size = 31;
  const SurfaceValues m{0, 0.5, 0.5, 20, 0, glm::dvec3(1)};
  Light point = lightOf(Light::Type::point);
  point.position = {0.7, 0.5, 1.2};
  for (Shading shading : {Shading::phong, Shading::blinnPhong, Shading::environment})
    for (bool infinite : {false, true}) {
      Look look = parallelLook({0, 0, 1}, size);
      look.cameraOrthographic = false;
      look.cameraPosition = glm::dvec3(0, 0, 1);
      look.cameraViewAngle = 90;
      look.shading = shading;
      look.light = {point};
      if (infinite) look.viewer = glint::Viewer::infinite;
      Material material = materialOf(0, m.diffuse, m.specular, m.exponent);
      material.shading.ior = 1;
      const Image image = draw(sceneOf(quad(), material), look);
      for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
          const glm::dvec3 p((x + 0.5) / size * 2 - 1, 1 - (y + 0.5) / size * 2, 0);
          const glm::dvec3 v = infinite ? glm::dvec3(0, 0, 1) : unit(glm::dvec3(0, 0, 1) - p);
          const glm::dvec3 expected = shaded(m, glm::dvec3(0), {0, 0, 1}, unit(point.position - p),
                                             v, shading != Shading::phong);
          // Interpolated positions carry some 32 roundings of the square's size, 4, at distances of
          // 1: 8e-6, where directions at best carry 8 roundings: 16 times the usual tolerance.
          expectColor(color(image, x, y), expected,
                      16 * lobeTolerance(shading == Shading::phong ? 20 : 80));
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Render, Sum, softwareBackends(), nameOfBackend);

}  // namespace glint::test::render_sum_gl_test
