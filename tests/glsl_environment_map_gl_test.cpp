// glsl/environment_map.glsl compared with the built-in environments in double (src/shading).

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

#include "glint/shading/environment_map.h"
#include "glsl_probe.h"

namespace glint::glsl_environment_map_gl_test {

struct Map {
  const char* name;
  BuiltinEnvironment environment;
  int value;  // of ENVIRONMENT_MAP
};
constexpr Map maps[] = {{"studio", BuiltinEnvironment::studio, 0},
                        {"sky", BuiltinEnvironment::sky, 1},
                        {"white", BuiltinEnvironment::white, 2}};

Probe probeOf(const Map& map) {
  return Probe(glslSources(), {{"vector.glsl", "environment_map.glsl"},
                               {{"ENVIRONMENT_STUDIO", 0},
                                {"ENVIRONMENT_SKY", 1},
                                {"ENVIRONMENT_WHITE", 2},
                                {"ENVIRONMENT_MAP", map.value}}});
}

constexpr const char* radiance = "vec3 environmentRadiance(vec3)";

glm::dvec3 at(const Column& column, std::size_t row) {
  return {column[3 * row], column[3 * row + 1], column[3 * row + 2]};
}

void push(Column& column, const glm::dvec3& v) {
  for (int i = 0; i < 3; ++i) column.push_back(float(v[i]));
}

/// Directions all around, near the horizon, the sun, and the lights' centres and edges, with
/// lengths from 10^low to 10^high.
Column directions(double low, double high, std::size_t rows) {
  std::mt19937 random(17);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> u(0, 1);
  Column column;
  for (std::size_t i = 0; i < rows; ++i) {
    const glm::dvec3 spread(normal(random), normal(random), normal(random));
    glm::dvec3 d = spread;
    const double reach = std::exp(-12 * u(random));
    if (i % 4 == 1) d.y *= reach;
    if (i % 4 == 2) d = skyConstants.sun + reach * spread;
    if (i % 8 == 6) {  // the edge of the sun's disc
      const glm::dvec3 side = glm::normalize(glm::cross(skyConstants.sun, spread));
      d = skyConstants.sun + (0.06 + 0.09 * u(random)) * side;
    }
    if (i % 4 == 3) {
      const BoxLight& light = studioConstants.lights[i / 4 % 3];
      const double x = (u(random) * 2 - 1) * 1.3 * light.halfWidth;
      const double y = (u(random) * 2 - 1) * 1.3 * light.halfHeight;
      d = x * light.right + y * light.up + std::sqrt(std::max(1 - x * x - y * y, 0.0)) * light.axis;
    }
    const double length = glm::length(d);
    if (!(length > 0)) continue;
    push(column, d / length * std::pow(10.0, low + (high - low) * u(random)));
  }
  return column;
}

/// How fast the radiance changes with direction, as its largest component: differences over 2e-4 in
/// two perpendicular directions.
double slope(const Map& map, const glm::dvec3& direction) {
  const double length = glm::length(direction);
  if (!(length > 0)) return 0;
  const glm::dvec3 d = direction / length;
  const glm::dvec3 across = glm::normalize(
      glm::cross(d, std::abs(d.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
  double largest = 0;
  for (const glm::dvec3& side : {across, glm::cross(d, across)}) {
    const glm::dvec3 change = (environmentRadiance(map.environment, d + 1e-4 * side) -
                               environmentRadiance(map.environment, d - 1e-4 * side)) /
                              2e-4;
    for (int i = 0; i < 3; ++i) largest = std::max(largest, std::abs(change[i]));
  }
  return largest;
}

/// The radiance is a polynomial of direction cosines, each off by about 3e-7 perpendicularly:
/// unit(), a dot product and rounded constants. Constants and sums add some roundings of the value,
/// at most 2.9. Along the direction, which unit() leaves 2e-7 too long or short, the sky's glow
/// changes by 0.55 * 64 g^64 + 0.3 * 8 g^8. The largest total is 2e-5, where two edges of a light
/// meet.
double bound(const Map& map, const glm::dvec3& direction) {
  if (map.environment == BuiltinEnvironment::white) return 0;
  double glow = 0;
  if (map.environment == BuiltinEnvironment::sky && glm::length(direction) > 0) {
    const double g = std::max(glm::dot(glm::normalize(direction), skyConstants.sun), 0.0);
    glow = 64 * skyConstants.narrow * std::pow(g, 64) + 8 * skyConstants.wide * std::pow(g, 8);
  }
  return 6e-7 + 3e-7 * slope(map, direction) + 2e-7 * glow;
}

class GlslEnvironmentMap : public GlslTest {
 protected:
  void expectRadiance(const Map& map, const Column& d, const std::string& what) {
    Probe probe = probeOf(map);
    double allowed = 0;
    const ErrorRecord record = measureErrors(
        probe.run(radiance, {d}), 3,
        [&](std::size_t row, std::size_t i) {
          return environmentRadiance(map.environment, at(d, row))[int(i)];
        },
        [&](std::size_t row, std::size_t i) {
          if (i == 0) allowed = bound(map, at(d, row));
          return allowed;
        });
    expectWithin(record, map.name + what, {d}, {3});
  }
};

TEST_P(GlslEnvironmentMap, UnitDirections) {
  for (const Map& map : maps) expectRadiance(map, directions(0, 0, 150000), "");
}

TEST_P(GlslEnvironmentMap, DirectionsOfAnyLength) {
  for (const Map& map : maps) {
    expectRadiance(map, directions(-30, 38, 30000), " any length");
    expectRadiance(map, {1e-30f, 0, 0, 0, 1e30f, 0, -1e30f, 1e30f, 1e30f, 0, -1e-30f, 1e-30f},
                   " extreme lengths");
    expectRadiance(map, {0, 0, 0, -0.0f, 0, -0.0f}, " no direction");
  }
}

TEST_P(GlslEnvironmentMap, AxesAndCentres) {
  Column d;
  for (int axis = 0; axis < 3; ++axis)
    for (double sign : {-1.0, 1.0}) {
      glm::dvec3 v(0.0);
      v[axis] = sign;
      push(d, v);
    }
  push(d, skyConstants.sun);
  for (const BoxLight& light : studioConstants.lights) push(d, light.axis);
  for (const Map& map : maps) expectRadiance(map, d, " axes");
}

TEST_P(GlslEnvironmentMap, HuntedWorstInput) {
  for (const Map& map : maps) {
    Probe probe = probeOf(map);
    const SearchResult worst = huntWorst(
        {{-1, 1, {0, 0.48f}}, {-1, 1, {0, 0.64f, 0.05f, -0.05f}}, {-1, 1, {0, 0.6f}}},
        [&](const std::vector<Column>& c) {
          Column d;
          for (std::size_t i = 0; i < c[0].size(); ++i)
            d.insert(d.end(), {c[0][i], c[1][i], c[2][i]});
          const Column got = probe.run(radiance, {d});
          std::vector<double> errors(c[0].size());
          for (std::size_t row = 0; row < errors.size(); ++row) {
            if (!(glm::length(at(d, row)) > 1e-30)) continue;  // subnormals may count as 0
            const glm::dvec3 truth = environmentRadiance(map.environment, at(d, row));
            const double allowed = std::max(bound(map, at(d, row)), 1e-9);
            for (std::size_t i = 0; i < 3; ++i)
              errors[row] =
                  std::max(errors[row], absoluteError(got[3 * row + i], truth[int(i)]) / allowed);
          }
          return errors;
        },
        1 << 14, 20);
    EXPECT_LE(worst.error, 1) << map.name << describeRow({worst.input}, {3}, 0);
    if (printsErrors())
      std::printf("hunted: %s %.3g of the bound at %s\n", map.name, worst.error,
                  describeRow({worst.input}, {3}, 0).c_str());
  }
}

GLINT_ON_SOFTWARE_BACKENDS(GlslEnvironmentMap);

}  // namespace glint::glsl_environment_map_gl_test
