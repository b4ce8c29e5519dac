#include "glint/shading/environment_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace glint::environment_map_test {

using glm::dvec3;

constexpr BuiltinEnvironment all[] = {BuiltinEnvironment::white, BuiltinEnvironment::sky,
                                      BuiltinEnvironment::studio};

double luminance(const dvec3& c) { return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z; }

/// Calls f(direction) for evenly spread points on the sphere (a Fibonacci lattice).
template <class F>
void overSphere(int count, F f) {
  const double golden = std::numbers::pi * (3.0 - std::sqrt(5.0));
  for (int i = 0; i < count; ++i) {
    const double y = 1.0 - (2.0 * i + 1.0) / count;
    const double r = std::sqrt(1.0 - y * y);
    f(dvec3(r * std::cos(golden * i), y, r * std::sin(golden * i)));
  }
}

TEST(EnvironmentMap, WhiteIsAFurnace) {
  overSphere(1000, [](const dvec3& d) {
    EXPECT_EQ(environmentRadiance(BuiltinEnvironment::white, d), dvec3(1.0));
  });
}

TEST(EnvironmentMap, BrightnessIsAsDocumented) {
  const struct {
    BuiltinEnvironment environment;
    double mean, least, most;
  } rows[] = {{BuiltinEnvironment::sky, 0.411, 0.14, 2.3},
              {BuiltinEnvironment::studio, 0.486, 0.08, 3.0}};
  for (const auto& row : rows) {
    double mean = 0.0, least = 1e9, most = 0.0;
    const int count = 100000;
    overSphere(count, [&](const dvec3& d) {
      const dvec3 e = environmentRadiance(row.environment, d);
      mean += luminance(e) / count;
      least = std::min({least, e.x, e.y, e.z});
      most = std::max({most, e.x, e.y, e.z});
    });
    // The mean is that of the formulas as chosen, to 0.001, so that a changed constant is noticed.
    EXPECT_NEAR(mean, row.mean, 0.001) << int(row.environment);
    EXPECT_NEAR(least, row.least, 0.001);
    EXPECT_LE(most, row.most);
    EXPECT_GE(most, 0.9 * row.most);
  }
}

// Values computed by hand from the formulas of the header.
TEST(EnvironmentMap, IsTheFormulaOfTheHeader) {
  const auto sky = glint::skyConstants;
  const dvec3 nadir = environmentRadiance(BuiltinEnvironment::sky, {0, -1, 0});
  EXPECT_NEAR(glm::length(nadir - sky.groundNadir), 0.0, 1e-15);
  const dvec3 sun = environmentRadiance(BuiltinEnvironment::sky, sky.sun);
  const double haze = std::pow(1.0 - 0.64, 3.0);
  const dvec3 air = sky.zenith * (1.0 - haze) + sky.horizon * haze;
  EXPECT_NEAR(glm::length(sun - (air + 2.05 * sky.sunColor)), 0.0, 1e-14);
  const dvec3 level = environmentRadiance(BuiltinEnvironment::sky, {-1, 0, 0});  // no sun there
  EXPECT_NEAR(glm::length(level - 0.5 * (sky.horizon + sky.groundHorizon)), 0.0, 1e-15);
  // 2^-8 and 2^-64 of the glow 60 degrees from the sun
  const dvec3 axis = glm::normalize(glm::cross(sky.sun, dvec3(0, 1, 0)));
  const dvec3 d = 0.5 * sky.sun + std::sqrt(0.75) * axis;
  const double h = std::pow(1.0 - 0.32, 3.0);
  const dvec3 expected = sky.zenith * (1.0 - h) + sky.horizon * h + 0.30 / 256.0 * sky.sunColor;
  EXPECT_NEAR(glm::length(environmentRadiance(BuiltinEnvironment::sky, d) - expected), 0.0, 1e-14);

  const auto studio = glint::studioConstants;
  const dvec3 floor = environmentRadiance(BuiltinEnvironment::studio, {0, -1, 0});
  EXPECT_NEAR(glm::length(floor - (dvec3(0.07) + studio.bounce)), 0.0, 1e-15);
  const dvec3 back = environmentRadiance(BuiltinEnvironment::studio, {0, 0.28, -0.96});
  const double s = 0.28 * 0.28 * (3.0 - 0.56);
  EXPECT_NEAR(glm::length(back - dvec3(0.24 + 0.45 * 0.96 * 0.96 + 0.30 * s)), 0.0, 1e-14);
  for (const glint::BoxLight& light : studio.lights) {
    const double y = light.axis.y;
    const double room = 0.24 + 0.30 * y * y * (3.0 - 2.0 * y);
    const dvec3 e = environmentRadiance(BuiltinEnvironment::studio, light.axis);
    EXPECT_NEAR(glm::length(e - (dvec3(room) + light.color)), 0.0, 1e-6);
    // half way across its edge, half of the light
    const dvec3 edge = std::sqrt(1.0 - light.halfWidth * light.halfWidth) * light.axis +
                       light.halfWidth * light.right;
    const double t = edge.y;
    const double there =
        0.24 + 0.30 * t * t * (3.0 - 2.0 * t) + 0.45 * std::pow(std::max(-edge.z, 0.0), 2.0);
    const dvec3 half = environmentRadiance(BuiltinEnvironment::studio, edge);
    EXPECT_NEAR(glm::length(half - (dvec3(there) + 0.5 * light.color)), 0.0, 1e-6);
    // and none behind
    EXPECT_LT(environmentRadiance(BuiltinEnvironment::studio, -light.axis).y, 0.5);
  }
}

TEST(EnvironmentMap, ConstantsAreUnitAndOrthogonal) {
  EXPECT_NEAR(glm::length(glint::skyConstants.sun), 1.0, 1e-15);
  for (const glint::BoxLight& light : glint::studioConstants.lights) {
    for (const dvec3& v : {light.axis, light.right, light.up}) {
      EXPECT_NEAR(glm::length(v), 1.0, 1e-15);
    }
    EXPECT_NEAR(glm::dot(light.axis, light.right), 0.0, 1e-15);
    EXPECT_NEAR(glm::dot(light.axis, light.up), 0.0, 1e-15);
    EXPECT_NEAR(glm::dot(light.up, light.right), 0.0, 1e-15);
  }
}

// The steepest edges are the sky's horizon and the sun's disc: nothing changes by more than 60 per
// radian (1.1 per degree), so that a picture a few hundred pixels wide does not alias, and a
// direction rounded to float, 6e-8 off, causes an error of 4e-6.
TEST(EnvironmentMap, IsSmooth) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  double steepest = 0.0;
  for (const BuiltinEnvironment environment : all) {
    overSphere(20000, [&](const dvec3& d) {
      const dvec3 other = d + 1e-4 * dvec3(normal(random), normal(random), normal(random));
      const double distance = glm::length(glm::normalize(other) - d);
      const double rise = glm::length(environmentRadiance(environment, other) -
                                      environmentRadiance(environment, d));
      steepest = std::max(steepest, rise / distance);
    });
  }
  EXPECT_LT(steepest, 60.0);
}

TEST(EnvironmentMap, IsTotalAndAsksForNoUnitDirection) {
  const double odd[] = {0.0,
                        -0.0,
                        1.0,
                        -1.0,
                        1e-320,
                        1e308,
                        std::numeric_limits<double>::infinity(),
                        std::numeric_limits<double>::quiet_NaN()};
  for (const BuiltinEnvironment environment : all) {
    for (const double x : odd) {
      for (const double y : odd) {
        for (const double z : odd) {
          const dvec3 e = environmentRadiance(environment, {x, y, z});
          for (int i = 0; i < 3; ++i) EXPECT_TRUE(e[i] >= 0.0 && e[i] <= 3.0) << x << ' ' << y;
        }
      }
    }
    overSphere(200, [&](const dvec3& d) {
      const dvec3 e = environmentRadiance(environment, d);
      EXPECT_LT(glm::length(environmentRadiance(environment, 1e200 * d) - e), 1e-13);
      EXPECT_LT(glm::length(environmentRadiance(environment, 1e-200 * d) - e), 1e-13);
    });
  }
}

}  // namespace glint::environment_map_test
