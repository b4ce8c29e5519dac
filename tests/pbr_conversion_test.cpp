#include "glint/shading/pbr_conversion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace pbr_conversion_test {

constexpr double u = 0x1p-53;

glint::ConvertedParameters convert(double metallic, double roughness) {
  return glint::convertPbr({.metallic = metallic, .roughness = roughness});
}

TEST(Conversion, ExponentFollowsRoughness) {
  EXPECT_EQ(glint::exponentFromRoughness(1.0), 0.0);
  EXPECT_NEAR(glint::exponentFromRoughness(0.5), 7.5, 16 * u);
  EXPECT_NEAR(glint::exponentFromRoughness(0.2), 312.0, 1024 * u);
  EXPECT_NEAR(glint::exponentFromRoughness(0.1), 4999.5, 1e-11);
  EXPECT_EQ(glint::exponentFromRoughness(0.0), glint::exponentFromRoughness(0.1));
  EXPECT_EQ(glint::exponentFromRoughness(2.0), 0.0);
  for (double r = 0.1; r <= 1.0; r += 0.01) {
    // r^4 has four roundings, and the root a quarter of their effect on alpha
    EXPECT_NEAR(glint::roughnessFromExponent(glint::exponentFromRoughness(r)), r, 8 * u) << r;
  }
  EXPECT_EQ(glint::roughnessFromExponent(1e6), 0.1);
  EXPECT_EQ(glint::roughnessFromExponent(-1.0), 1.0);
}

// A weak highlight's peak, and the uniform part that it omits, give the lobe
// (1 + peak / share / F0) / pi cos^a, which reflects about as much as arrives: here with L = N,
// where N.H = cos(theta / 2), by the midpoint rule.
TEST(Conversion, TheLobeReflectsWhatComes) {
  for (const double a : {0.0, 30.0, 1248.0}) {
    const int steps = 20000;
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) {
      const double theta = std::acos(0.0) * (i + 0.5) / steps;
      sum += std::pow(std::cos(theta / 2.0), a) * std::cos(theta) * std::sin(theta);
    }
    const double integral = 2.0 * std::acos(-1.0) * sum * std::acos(0.0) / steps;
    const double share = a > 0.0 ? a / (a + 8.0) : 1.0;
    const double peak = 1.0 + glint::highlightPeak(1e-9, a / 4.0) / 1e-9 / share;
    // the usual a + 8 is a fit: 4.8 % high at a = 30
    EXPECT_NEAR(peak / std::acos(-1.0) * integral, 1.0, 0.05) << a;
  }
}

TEST(Conversion, HighlightPeak) {
  // alpha' = 30 at r = 0.5: x = F0 (30/8)(30/38)
  EXPECT_NEAR(glint::highlightPeak(1e-6, 7.5), 1e-6 * 112.5 / 38.0, 1e-10);
  const double x = 0.04 * 112.5 / 38.0;
  EXPECT_NEAR(glint::highlightPeak(0.04, 7.5), x / (1.0 + x), 4 * u);
  for (const double f0 : {0.0, 0.02, 0.04, 0.5, 1.0}) {
    double last = -1.0;
    for (double r = 1.0; r > 0.1; r -= 0.01) {
      const double peak = glint::highlightPeak(f0, glint::exponentFromRoughness(r));
      EXPECT_TRUE(peak >= last && peak < 1.0) << f0 << ' ' << r;
      last = peak;
    }
  }
}

TEST(Conversion, RoughIsDullAndSmoothIsBright) {
  for (const double metallic : {0.0, 1.0}) {
    EXPECT_EQ(convert(metallic, 1.0).specular, 0.0);
    EXPECT_LT(convert(metallic, 0.8).specular, 0.1);  // alpha = 0.7: a wide disc with an edge
  }
  EXPECT_NEAR(convert(0, 0.5).specular, 0.106, 0.001);
  EXPECT_NEAR(convert(1, 0.5).specular, 0.748, 0.001);
  EXPECT_GT(convert(0, 0.2).specular, 0.8);
  EXPECT_GT(convert(1, 0.2).specular, 0.99);
}

TEST(Conversion, MetalsAndDielectrics) {
  const auto plastic = convert(0, 0.3), metal = convert(1, 0.3), half = convert(0.5, 0.3);
  EXPECT_EQ(plastic.ambient, 1.0);
  EXPECT_EQ(plastic.diffuse, 1.0);
  EXPECT_EQ(plastic.metalness, 0.0);
  EXPECT_EQ(plastic.ior, 1.5);
  EXPECT_NEAR(metal.diffuse, 0.6, u);
  EXPECT_EQ(metal.metalness, 1.0);
  EXPECT_NEAR(half.specular, 0.5 * (plastic.specular + metal.specular), 4 * u);
  EXPECT_NEAR(half.diffuse, 0.8, 4 * u);
  EXPECT_EQ(half.metalness, 0.5);
  // KHR_materials_specular and _ior
  EXPECT_EQ(glint::convertPbr({.metallic = 0, .roughness = 0.3, .specularFactor = 0}).specular,
            0.0);
  const auto diamond = glint::convertPbr({.metallic = 0, .roughness = 0.5, .ior = 2.4});
  const double x = 0.16955017 * 112.5 / 38.0;
  EXPECT_NEAR(diamond.specular, x / (1.0 + x), 1e-8);
  EXPECT_EQ(diamond.ior, 2.4);
  EXPECT_EQ(glint::convertPbr({.metallic = 0, .ior = 0}).ior, 1e3);
  EXPECT_EQ(glint::convertPbr({.metallic = 0, .ior = 0.5}).ior, 1.0);
}

TEST(Conversion, IsTotal) {
  const double infinity = std::numeric_limits<double>::infinity();
  const double odd[] = {
      0.0, -1.0, 0.5, 1e308, infinity, -infinity, std::numeric_limits<double>::quiet_NaN()};
  for (const double a : odd) {
    for (const double b : odd) {
      const auto out = glint::convertPbr({a, b, b, a});
      EXPECT_TRUE(out.specular >= 0.0 && out.specular <= 1.0);
      EXPECT_TRUE(out.diffuse >= 0.6 && out.diffuse <= 1.0);
      EXPECT_TRUE(out.exponent >= 0.0 && out.exponent <= 4999.6);
      EXPECT_TRUE(out.ior >= 1.0 && out.ior <= 1e3);
      EXPECT_TRUE(out.metalness >= 0.0 && out.metalness <= 1.0);
      EXPECT_TRUE(std::isfinite(glint::highlightPeak(a, b)));
    }
  }
}

}  // namespace pbr_conversion_test
