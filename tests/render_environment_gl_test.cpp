// The program environment: closed cases of reflection and refraction.

#include <gmock/gmock.h>

#include <vector>

#include "formulas.h"
#include "glint/shading/environment_map.h"
#include "stage.h"

namespace glint::test::render_environment_gl_test {

Look mirrorLook(const glm::dvec3& toViewer = {0, 0, 1}, int pixels = 3) {
  Look look = parallelLook(toViewer, pixels);
  look.shading = Shading::environment;
  look.environment = Environment::white;
  look.noLights = true;
  return look;
}

// Glass that transmits everything, in a colour without absorption.
Material glass(double transmission = 1, double ior = 1.5) {
  Material m = materialOf(1, 1, 1, 20);
  m.shading.transmission = transmission;
  m.shading.ior = ior;
  return m;
}

// Seen along (0, 0, -1), with the normal tilted so that N.V = cosine.
Mesh inclined(double cosine) {
  return quad({std::sqrt(1 - cosine * cosine) * 0.6, std::sqrt(1 - cosine * cosine) * 0.8, cosine});
}

// The same square showing its back face.
Mesh turnedAway(double cosine) {
  Mesh mesh = inclined(cosine);
  for (glm::vec3& n : mesh.normals) n = -n;
  mesh.indices = {0, 2, 1, 0, 3, 2};
  return mesh;
}

// The error allowed for R: the cancellation-free form's own 4.5e-7 (docs/science.md 4.3), and its
// slope times the rounding of the cosine (8 roundings).
double reflectanceTolerance(double cosine, double n1, double n2) {
  const double step = 8 * rounding, c0 = std::max(0.0, cosine - step),
               c1 = std::min(1.0, cosine + step);
  return 5e-7 + std::abs(reflectance(c1, n1, n2) - reflectance(c0, n1, n2));
}

class EnvironmentProgram : public OnStage {
 protected:
  glm::dvec3 seen(const Mesh& mesh, const Material& material, const Look& look) {
    const Image image = draw(sceneOf(mesh, material), look);
    EXPECT_TRUE(isFinite(image));
    return middle(image);
  }
};

// A surface that neither absorbs nor emits is invisible in a furnace: F + (1 - F) = 1 at every
// pixel. Each sum rounds a few times; 2e-6 is 32 roundings.
TEST_P(EnvironmentProgram, WhiteFurnaceShowsNothingOfGlass) {
  for (double ior : {0.6, 1.0, 1.33, 1.5, 2.4, 100.0})
    for (double metalness : {0.0, 0.4, 1.0})
      for (double alpha : {1.0, 0.0}) {
        Material m = glass(1, ior);
        m.shading.metalness = metalness;
        m.doubleSided = true;
        m.alphaMode = glint::AlphaMode::blend;
        m.alpha = alpha;  // 0: no surface is visible, only the background
        Look look = mirrorLook({1, 2, 3}, 64);
        look.cameraViewAngle = 40;  // the sphere and some background
        const Image image = draw(sceneOf(sphere(48, 24), m), look);
        std::size_t covered = 0;
        for (int y = 0; y < 64; ++y)
          for (int x = 0; x < 64; ++x) {
            const glm::dvec3 c = color(image, x, y);
            if (c == glm::dvec3(0)) continue;
            ++covered;
            expectColor(c, glm::dvec3(1), 2e-6);
          }
        if (alpha == 1)
          EXPECT_GT(covered, 800u);
        else
          EXPECT_EQ(covered, 0u);
        if (HasFailure()) {
          FAIL() << "index " << ior << " metalness " << metalness << " alpha " << alpha;
        }
      }
}

TEST_P(EnvironmentProgram, ReflectsByFresnelsEquations) {
  for (double ior : {0.5, 1.33, 1.5, 2.4, 10.0})
    for (double cosine : {1.0, 0.9, 0.70710678, 0.5, 0.25881905, 0.1, 0.01}) {
      const glm::dvec3 r = seen(inclined(cosine), glass(0, ior), mirrorLook());
      expectColor(r, glm::dvec3(reflectance(cosine, 1, ior)), reflectanceTolerance(cosine, 1, ior));
    }
  // docs/science.md 8.3 and K12, n = 1.5, light from outside.
  const std::pair<double, double> published[] = {
      {0, 0.04}, {45, 0.0502399}, {56.309932474, 0.0739645}, {60, 0.0891867}, {75, 0.2530606}};
  for (const auto& [angle, expected] : published) {
    const double c = std::cos(angle * degrees);
    expectColor(seen(inclined(c), glass(0), mirrorLook()), glm::dvec3(expected),
                reflectanceTolerance(c, 1, 1.5) + 5e-8);  // half a unit of the last printed digit
  }
}

TEST_P(EnvironmentProgram, LeavesThroughBackFacesWithTotalReflection) {
  Material m = glass(0);
  m.doubleSided = true;
  // The critical angle of n = 1.5 is 41.81 degrees, cosine 0.745356.
  for (double cosine : {0.74, 0.6, 0.3, 0.05}) {
    EXPECT_EQ(seen(turnedAway(cosine), m, mirrorLook()), glm::dvec3(1)) << cosine;
    m.shading.transmission = 1;  // and nothing is refracted
    EXPECT_EQ(seen(turnedAway(cosine), m, mirrorLook()), glm::dvec3(1)) << cosine;
    m.shading.transmission = 0;
  }
  for (double cosine : {0.76, 0.8, 0.95, 1.0}) {
    expectColor(seen(turnedAway(cosine), m, mirrorLook()), glm::dvec3(reflectance(cosine, 1.5, 1)),
                reflectanceTolerance(cosine, 1.5, 1));
  }
}

TEST_P(EnvironmentProgram, MediumIsWhatTheViewerIsIn) {
  Look look = mirrorLook();
  look.mediumIor = 1.33;
  for (double cosine : {0.9, 0.4})
    expectColor(seen(inclined(cosine), glass(0), look), glm::dvec3(reflectance(cosine, 1.33, 1.5)),
                reflectanceTolerance(cosine, 1.33, 1.5));
  // K1, K2: equal indices are not a boundary, also at grazing incidence.
  look.mediumIor = 1.5;
  for (double cosine : {1.0, 0.5, 1e-4})
    EXPECT_EQ(seen(inclined(cosine), glass(0), look), glm::dvec3(0)) << cosine;
}

TEST_P(EnvironmentProgram, FormsOfTheReflectance) {
  for (double cosine : {1.0, 0.6, 0.2}) {
    Look look = mirrorLook();
    look.fresnel = glint::Fresnel::textbook;
    expectColor(seen(inclined(cosine), glass(0), look), glm::dvec3(reflectance(cosine, 1, 1.5)),
                reflectanceTolerance(cosine, 1, 1.5));
    look.fresnel = glint::Fresnel::schlick;
    look.schlickExponent = 4;
    // Four powers of 1 - c, which is off by 8 roundings, and a power function of some 8 more.
    expectColor(seen(inclined(cosine), glass(0), look),
                glm::dvec3(0.04 + 0.96 * std::pow(1 - cosine, 4)), 48 * rounding);
  }
  // E2: from the denser side, the cosine of the refracted angle, at 40 degrees.
  Material m = glass(0);
  m.doubleSided = true;
  Look look = mirrorLook();
  look.fresnel = glint::Fresnel::schlick;
  const double c = std::cos(40 * degrees), cosT = std::sqrt(1 - 2.25 * (1 - c * c));
  // d cosT / d c = 2.25 c / cosT = 6.5; five powers.
  expectColor(seen(turnedAway(c), m, look), glm::dvec3(0.04 + 0.96 * std::pow(1 - cosT, 5)),
              5 * 7 * 8 * rounding + 16 * rounding);
}

// F = C + (1 - C)(1 - N.V)^5 for a metal; the environment is scaled by neither m_s nor S.
TEST_P(EnvironmentProgram, MetalsReflectInTheirColour) {
  const glm::dvec3 c(0.9, 0.5, 0.2);
  for (double cosine : {1.0, 0.5, 0.1})
    for (double metalness : {1.0, 0.3}) {
      Material m = materialOf(0, 0, 0.123, 20, metalness, c);
      const glm::dvec3 metal = c + (1.0 - c) * std::pow(1 - cosine, 5);
      const glm::dvec3 expected = (1 - metalness) * reflectance(cosine, 1, 1.5) + metalness * metal;
      expectColor(seen(inclined(cosine), m, mirrorLook()), expected,
                  5 * 8 * rounding + reflectanceTolerance(cosine, 1, 1.5));
    }
}

TEST_P(EnvironmentProgram, TransparencyReplacesTheSum) {
  const glm::dvec3 c(0.8, 0.4, 0.2);
  for (double t : {0.0, 0.25, 1.0}) {
    Look look = mirrorLook();
    look.ambientLight = glm::dvec3(0.5);
    Material m = materialOf(1, 0, 0, 1, 0, c);
    m.shading.transmission = t;
    const double cosine = 0.7, r = reflectance(cosine, 1, 1.5);
    const glm::dvec3 expected = (1 - t) * 0.5 * c + r + t * (1 - r) * c;
    expectColor(seen(inclined(cosine), m, look), expected,
                16 * rounding + 2 * reflectanceTolerance(cosine, 1, 1.5));
    // Alpha is coverage: all terms are blended over the background.
    m.alphaMode = glint::AlphaMode::blend;
    look.backgroundColor = {0.25, 0.5, 1};
    for (const double alpha : {0.0, 0.375, 1.0}) {
      m.alpha = alpha;
      const Image image = draw(sceneOf(inclined(cosine), m), look);
      expectColor(middle(image), alpha * expected + (1 - alpha) * look.backgroundColor,
                  16 * rounding + 2 * reflectanceTolerance(cosine, 1, 1.5));
      EXPECT_EQ(pixel(image, 1, 1).w, 1);
    }
  }
}

// In environments that are not white: the world-space directions of reflection and refraction,
// compared with the environments in double. A direction is off by some 16 roundings (1e-6), and the
// steepest edge of the environments rises by 2.45 * 1.5 / (2 * 0.05) = 37 per radian; their own
// formulas in float add 1e-5 (environment_map.h).
TEST_P(EnvironmentProgram, LooksAlongReflectedAndRefractedRays) {
  const double tolerance = 37 * 1e-6 + 1e-5;
  const std::pair<Environment, glint::BuiltinEnvironment> maps[] = {
      {Environment::studio, glint::BuiltinEnvironment::studio},
      {Environment::sky, glint::BuiltinEnvironment::sky}};
  for (const auto& [map, reference] : maps)
    for (const glm::dvec3 v : {glm::dvec3(0, 0, 1), glm::dvec3(-1, 0.4, 0.3)})
      for (const glm::dvec3 turn : {glm::dvec3(0, 0, 0), glm::dvec3(0.5, 0.2, 0.1),
                                    glm::dvec3(-0.3, 0.6, 0.2), glm::dvec3(0.1, -0.9, 0)})
        for (double angle : {0.0, 70.0}) {
          const glm::dvec3 view = unit(v), n = unit(view + turn);
          Look look = mirrorLook(v);
          look.environment = map;
          look.environmentRotation = angle;
          Mesh mesh = quad();
          const glm::dvec3 right = unit(glm::cross(glm::dvec3(0, 1, 0), view)),
                           up = glm::cross(view, right);
          for (glm::vec3& p : mesh.positions) p = glm::vec3(double(p.x) * right + double(p.y) * up);
          mesh.normals.assign(4, glm::vec3(n));
          // Rotated about +Y by the angle: a ray sees what was at the angle before.
          const auto radiance = [&, &e = reference](const glm::dvec3& d) {
            const double s = std::sin(-angle * degrees), c = std::cos(-angle * degrees);
            return glint::environmentRadiance(e, {c * d.x + s * d.z, d.y, -s * d.x + c * d.z});
          };
          const double cosine = glm::dot(n, view);
          const glm::dvec3 reflected = 2 * cosine * n - view;
          Material mirror = materialOf(0, 0, 0, 1, 1);
          expectColor(seen(mesh, mirror, look), radiance(reflected), tolerance, "mirror");
          const double r = reflectance(cosine, 1, 1.5);
          const glm::dvec3 along = (cosine * n - view) / 1.5;
          const glm::dvec3 refracted = along - std::sqrt(1 - glm::dot(along, along)) * n;
          expectColor(seen(mesh, glass(), look),
                      r * radiance(reflected) + (1 - r) * radiance(refracted),
                      tolerance + 5 * reflectanceTolerance(cosine, 1, 1.5), "glass");
        }
}

TEST_P(EnvironmentProgram, StandsBehindTheModelOnlyWhenAsked) {
  Look look;
  look.environment = Environment::sky;
  look.antiAliasing = {glint::AntiAliasing::Mode::none, 1};
  look.resolution = {48, 32};
  look.cameraPosition = glm::dvec3(1, 2, 3);
  look.cameraFocalPoint = glm::dvec3(0, 2.5, 0);
  look.cameraViewAngle = 70;
  const Scene away = sceneOf(quad(), materialOf(1, 1, 0, 1), translation({0, 0, 50}));
  EXPECT_EQ(coveredPixels(draw(away, look), look.backgroundColor), 0u);
  look.environmentBackground = true;
  const Image image = draw(away, look);
  const glm::dvec3 back = unit(*look.cameraPosition - *look.cameraFocalPoint);
  const glm::dvec3 right = unit(glm::cross(glm::dvec3(0, 1, 0), back)),
                   up = glm::cross(back, right);
  const double half = std::tan(35 * degrees);
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 48; ++x) {
      const glm::dvec3 ray = right * (((x + 0.5) / 48 * 2 - 1) * half * 1.5) +
                             up * ((1 - (y + 0.5) / 32 * 2) * half) - back;
      // The sun's edge rises by 1.2 * 1.5 / 0.008 in 1 - d.sun, at angles of 0.1: 23 per radian.
      expectColor(color(image, x, y),
                  glint::environmentRadiance(glint::BuiltinEnvironment::sky, unit(ray)),
                  37 * 1e-6 + 1e-5);
    }
}

INSTANTIATE_TEST_SUITE_P(Render, EnvironmentProgram, softwareBackends(), nameOfBackend);

}  // namespace glint::test::render_environment_gl_test
