#include "glint/shading/sum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "glint/shading/safe.h"

namespace glint::shading_sum_test {

using glm::dvec3;

constexpr double u = 0x1p-53;
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

const dvec3 white(1.0);
const dvec3 z(0.0, 0.0, 1.0);

SumParameters parameters(double exponent) {
  SumParameters p;
  p.ambient = 1.0;
  p.diffuse = 1.0;
  p.specular = 1.0;
  p.exponent = exponent;
  return p;
}

/// The direction in the plane y = 0 at this angle from +Z towards +X.
dvec3 at(double degrees) {
  const double radians = degrees * std::acos(-1.0) / 180.0;
  return {std::sin(radians), 0.0, std::cos(radians)};
}

void expectNear(const dvec3& a, const dvec3& b, double tolerance) {
  EXPECT_LE(glm::length(a - b), tolerance) << a.x << ' ' << a.y << ' ' << a.z;
}

TEST(ShadingSum, IsTheFormulaOfTheNotes) {
  SumParameters p;
  p.ambient = 0.5;
  p.diffuse = 0.7;
  p.specular = 0.4;
  p.exponent = 10.0;
  const dvec3 C(0.8, 0.4, 0.2), A(0.1, 0.2, 0.3), I(2.0, 1.0, 0.5);
  const dvec3 L = glm::normalize(dvec3(1, 2, 2));
  const dvec3 V = z;
  // N.L = 2/3, R.V = 2/3, N.H = 0.9128709292 (docs/science.md 8.4)
  LightTerms phong = glint::ambientLight(p, A);
  phong += glint::phongLight(p, z, L, V, I);
  const dvec3 S = 0.25 * C + dvec3(0.75);
  const dvec3 matte = 0.5 * C * A + 0.7 * C * I * (2.0 / 3.0);
  expectNear(glint::sumColor(phong, C, 0.25), matte + 0.4 * S * I * std::pow(2.0 / 3.0, 10.0),
             32 * u);
  LightTerms blinn = glint::ambientLight(p, A);
  blinn += glint::blinnPhongLight(p, z, L, V, I);
  expectNear(glint::sumColor(blinn, C, 0.25), matte + 0.4 * S * I * std::pow(5.0 / 6.0, 20.0),
             64 * u);
  p.blinnFactor = 2.0;
  expectNear(glint::blinnPhongLight(p, z, L, V, I).specular, 0.4 * I * std::pow(5.0 / 6.0, 10.0),
             64 * u);
}

TEST(ShadingSum, GatesOnTheLightAlone) {
  for (const auto light : {glint::phongLight, glint::blinnPhongLight}) {
    for (const double alpha : {0.0, 2.5, 5.0, 1e6}) {
      const auto p = parameters(alpha);
      const LightTerms peak = light(p, z, z, z, white);  // C1
      EXPECT_EQ(peak.matte, white);
      EXPECT_EQ(peak.specular, white);
      for (const dvec3& L : {-z, dvec3(1, 0, 0), at(90.0 + 1e-6), at(150.0), dvec3(0.0)}) {
        // C2, C3, C10, C11: including V = R, where the ungated lobe is 1
        for (const dvec3& V : {z, at(-150.0), dvec3(-1, 0, 0), dvec3(0.0)}) {
          const LightTerms off = light(p, z, L, V, white);
          EXPECT_EQ(off.matte, dvec3(0.0));
          EXPECT_EQ(off.specular, dvec3(0.0));
        }
      }
      const LightTerms away = light(p, z, at(60), at(120), white);  // C6: V = -R
      if (light == glint::phongLight) {
        EXPECT_EQ(away.specular, dvec3(0.0));
      }
      EXPECT_NEAR(away.matte.x, 0.5, 4 * u);
      const LightTerms opposed = glint::blinnPhongLight(p, z, at(60), -at(60), white);  // C7
      EXPECT_EQ(opposed.specular, dvec3(0.0));
      EXPECT_EQ(light(p, z, z, dvec3(0.0), white).specular, dvec3(0.0));  // C13
      EXPECT_EQ(light(p, dvec3(0.0), z, z, white).matte, dvec3(0.0));     // A1
    }
  }
  // C9: N.V < 0 is not gated. With L at 80 and V at -95 degrees, R and V are 15 degrees apart.
  const auto p = parameters(10.0);
  const double phong = glint::phongLight(p, z, at(80), at(-95), white).specular.x;
  EXPECT_NEAR(phong, std::pow(at(15).z, 10.0), 64 * u);
  const double blinn = glint::blinnPhongLight(p, z, at(80), at(-95), white).specular.x;
  EXPECT_NEAR(blinn, std::pow(at(7.5).z, 40.0), 1024 * u);  // |L + V| = 0.087
}

TEST(ShadingSum, TerminatorIsContinuousInDiffuseLight) {  // C4
  const auto p = parameters(5.0);
  EXPECT_NEAR(glint::phongLight(p, z, at(90.0 - 1e-6), z, white).matte.x, 1.745e-8, 1e-11);
  EXPECT_EQ(glint::phongLight(p, z, at(90.0 + 1e-6), z, white).matte.x, 0.0);
}

// The largest difference between Phong at alpha = 200 and Blinn-Phong at 800, over V around R:
// docs/science.md 3 (0.4727 at 60 degrees there; this finer search finds 0.47279).
TEST(ShadingSum, PhongAndBlinnDifferAsTabulated) {
  const auto p = parameters(200.0);
  for (const auto& [incidence, expected] :
       {std::pair{0.0, 0.0007}, {15.0, 0.0251}, {30.0, 0.1052}, {45.0, 0.25}, {60.0, 0.4728}}) {
    const dvec3 L = at(incidence), R = at(-incidence), inPlane = at(90.0 - incidence);
    double largest = 0.0;
    for (double turn = 0.0; turn <= 3.15; turn += 0.02) {
      const dvec3 aside = std::cos(turn) * inPlane + std::sin(turn) * dvec3(0, 1, 0);
      for (double angle = 0.0; angle < 0.4; angle += 1e-3) {
        const dvec3 V = std::cos(angle) * R + std::sin(angle) * aside;
        const double difference = glint::blinnPhongLight(p, z, L, V, white).specular.x -
                                  glint::phongLight(p, z, L, V, white).specular.x;
        largest = std::max(largest, std::abs(difference));
      }
    }
    EXPECT_NEAR(largest, expected, 6e-5) << incidence;  // half a digit, and the grid's 1e-5
  }
}

TEST(ShadingSum, LightsAddUp) {  // F1, F2, F4, F12, F13
  const auto p = parameters(30.0);
  const dvec3 L = at(20);
  LightTerms many;
  for (int i = 0; i < 64; ++i) many += glint::phongLight(p, z, L, z, white / 64.0);
  const LightTerms one = glint::phongLight(p, z, L, z, white);
  expectNear(many.matte, one.matte, 64 * u);
  expectNear(many.specular, one.specular, 64 * u);
  EXPECT_EQ(glint::phongLight(p, z, L, z, dvec3(0.0)).specular, dvec3(0.0));
  EXPECT_EQ(glint::phongLight(p, z, L, z, dvec3(1, 0, 0)).matte.y, 0.0);
  SumParameters black;
  black.ambient = black.diffuse = black.specular = 0.0;
  LightTerms none = glint::ambientLight(black, white);
  none += glint::blinnPhongLight(black, z, L, z, white);
  EXPECT_EQ(glint::sumColor(none, white, 0.5), dvec3(0.0));
}

TEST(ShadingSum, MetalnessColoursTheHighlight) {  // E9, F7, F8, F9
  const dvec3 black(0.0), red(0.9, 0.1, 0.1);
  EXPECT_EQ(glint::specularColor(black, 0.0), white);
  EXPECT_EQ(glint::specularColor(black, 1.0), black);
  EXPECT_EQ(glint::specularColor(red, 1.0), red);
  EXPECT_EQ(glint::specularColor(red, 2.0), red);
  EXPECT_EQ(glint::specularColor(red, -1.0), white);
  EXPECT_EQ(glint::specularColor(red, nan), white);
}

TEST(ShadingSum, IsTotal) {  // F5, F6
  const double odd[] = {0.0, -1.0, 1.0, 1e308, infinity, nan};
  for (const double a : odd) {
    for (const double b : odd) {
      SumParameters p;
      p.ambient = p.diffuse = p.specular = a;
      p.exponent = p.blinnFactor = b;
      for (const auto light : {glint::phongLight, glint::blinnPhongLight}) {
        LightTerms terms = light(p, z, at(10), at(5), dvec3(b, a, 1.0));
        terms += glint::ambientLight(p, dvec3(b));
        for (int i = 0; i < 3; ++i) {
          EXPECT_TRUE(std::isfinite(terms.matte[i]) && terms.matte[i] >= 0.0) << a << ' ' << b;
          EXPECT_TRUE(std::isfinite(terms.specular[i]) && terms.specular[i] >= 0.0);
        }
      }
      for (const double c : odd) {
        const double spot = glint::spotFalloff(a, b, c);
        EXPECT_TRUE(spot >= 0.0 && spot <= 1.0) << a << ' ' << b << ' ' << c;
      }
      const double far = glint::distanceFalloff(a, b);
      EXPECT_TRUE(std::isfinite(far) && far >= 0.0) << a << ' ' << b;
    }
  }
}

TEST(ShadingSum, SpotAndDistanceFallOff) {
  EXPECT_EQ(glint::spotFalloff(1.0, 0.9, 0.5), 1.0);
  EXPECT_EQ(glint::spotFalloff(0.9, 0.9, 0.5), 1.0);
  EXPECT_NEAR(glint::spotFalloff(0.7, 0.9, 0.5), 0.25, 4 * u);
  EXPECT_EQ(glint::spotFalloff(0.5, 0.9, 0.5), 0.0);
  EXPECT_EQ(glint::spotFalloff(-1.0, 0.9, 0.5), 0.0);
  EXPECT_EQ(glint::spotFalloff(0.51, 0.5, 0.5), 1.0);
  EXPECT_EQ(glint::spotFalloff(0.5, 0.5, 0.5), 0.0);
  EXPECT_EQ(glint::distanceFalloff(2.0, 0.0), 0.25);
  EXPECT_EQ(glint::distanceFalloff(2.0, infinity), 0.25);
  EXPECT_EQ(glint::distanceFalloff(1.0, 2.0), 15.0 / 16.0);
  EXPECT_EQ(glint::distanceFalloff(2.0, 2.0), 0.0);
  EXPECT_EQ(glint::distanceFalloff(3.0, 2.0), 0.0);
}

TEST(SafeNormalize, IsRightForEveryLength) {  // A1 to A8, C12
  EXPECT_EQ(glint::safeNormalize(dvec3(0.0)), dvec3(0.0));
  EXPECT_EQ(glint::safeNormalize(dvec3(-0.0, 0.0, 0.0)), dvec3(0.0));
  for (const double bad : {nan, infinity, -infinity}) {
    EXPECT_EQ(glint::safeNormalize(dvec3(bad, 0, 0)), dvec3(0.0));
    EXPECT_EQ(glint::safeNormalize(dvec3(1, 2, bad)), dvec3(0.0));
  }
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 1000; ++i) {
    const dvec3 v(normal(random), normal(random), normal(random));
    const dvec3 expected = v / std::sqrt(glm::dot(v, v));
    for (const double scale : {0x1p-1000, 1e-38, 1e-20, 1.0, 1e20, 0x1p1000}) {
      expectNear(glint::safeNormalize(scale * v), expected, 8 * u);
    }
  }
  expectNear(glint::safeNormalize(dvec3(1e-23, 2e-23, 2e-23)), dvec3(1, 2, 2) / 3.0, 4 * u);
  expectNear(glint::safeNormalize(dvec3(3e38)), dvec3(std::sqrt(1.0 / 3.0)), 4 * u);
  EXPECT_EQ(glint::safeNormalize(dvec3(5e-324, 0, 0)), dvec3(1, 0, 0));
  expectNear(glint::safeNormalize(dvec3(1.7e308)), dvec3(std::sqrt(1.0 / 3.0)), 4 * u);
}

}  // namespace glint::shading_sum_test
