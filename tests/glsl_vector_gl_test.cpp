// glsl/vector.glsl compared with double, for every length that a float can have.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

#include "glint/shading/safe.h"
#include "glsl_probe.h"

namespace glint::glsl_vector_gl_test {

// The square of the length is off by 3 relative roundings of 2^-24, its root by half as much and
// one of its own, the quotient by one more: 3.5 roundings or 2.1e-7 if the driver rounds division
// and root as IEEE does (GLSL allows 2.5 ulp each). Scaling by powers of two adds none.
constexpr double tolerance = 2.1e-7;

/// Random directions with lengths from 10^low to 10^high, some along the axes and planes.
Column vectors(double low, double high, std::size_t rows) {
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> u(0, 1);
  Column column;
  for (std::size_t i = 0; i < rows; ++i) {
    glm::dvec3 v(normal(random), normal(random), normal(random));
    if (i % 4 == 1) v[int(i / 4 % 3)] = 0;
    if (i % 4 == 2) v *= glm::dvec3(std::exp(-20 * u(random)), 1, std::exp(-40 * u(random)));
    if (i % 16 == 3) v = glm::dvec3(i % 3 == 0, i % 3 == 1, i % 3 == 2) * (i % 32 == 3 ? 1. : -1.);
    const double length = std::pow(10.0, low + (high - low) * u(random));
    v *= length / std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z), 1e-300});
    for (int k = 0; k < 3; ++k) column.push_back(float(v[k]));
  }
  return column;
}

glm::dvec3 at(const Column& column, std::size_t row) {
  return {column[3 * row], column[3 * row + 1], column[3 * row + 2]};
}

class GlslVector : public GlslTest {
 protected:
  ErrorRecord errors(const char* function, const Column& v) {
    Probe probe(glslSources(), {{"vector.glsl"}, {}});
    return measureErrors(
        probe.run(function, {v}), 3,
        [&](std::size_t row, std::size_t i) { return safeNormalize(at(v, row))[int(i)]; },
        [](std::size_t, std::size_t) { return tolerance; });
  }
};

TEST_P(GlslVector, UnitOfLengthsWithUsableSquares) {
  // Squares below 1.2e-38 are subnormal and may vanish: relative to 1e-30, the square of the
  // largest component, that is less than 2^-24.
  const Column v = vectors(-15, 18, 300000);
  expectWithin(errors("vec3 unit(vec3)", v), "unit", {v}, {3});
}

TEST_P(GlslVector, SafeUnitOfEveryLength) {
  // A component below 1.2e-38 is subnormal and may count as 0, which is negligible relative to
  // 1e-30.
  const Column v = vectors(-30, 38.5, 300000);
  expectWithin(errors("vec3 safeUnit(vec3)", v), "safeUnit", {v}, {3});
}

TEST_P(GlslVector, HardLengths) {
  Probe probe(glslSources(), {{"vector.glsl"}, {}});
  const auto safe = [&](const Column& v) { return probe.run("vec3 safeUnit(vec3)", {v}); };
  // A1, A8, C11: no direction.
  EXPECT_EQ(safe({0, 0, 0, -0.0f, 0, 0}), (Column{0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(probe.run("vec3 unit(vec3)", {Column{0, 0, 0, 1e-30f, 0, 0}}),
            (Column{0, 0, 0, 0, 0, 0}));
  // A2, A3, A5, A6, C12, I2, and the largest and smallest normal floats.
  const Column hard{1e-20f,   0,      0,      1e-23f, 2e-23f,   2e-23f,   1e20f,    1e20f,
                    0,        3e38f,  3e38f,  3e38f,  1e-30f,   0,        -1e-30f,  1e30f,
                    0,        1e30f,  -1,     1e-20f, 0,        3.4e38f,  -3.4e38f, 1,
                    1.2e-38f, 0,      0,      0,      1.2e-38f, 1.2e-38f, 1e16f,    1e16f,
                    1e16f,    1e-16f, 1e-16f, 1e-16f};
  const ErrorRecord record = errors("vec3 safeUnit(vec3)", hard);
  expectWithin(record, "safeUnit", {hard}, {3});
  // A4: subnormal components may count as 0, and then the whole vector does.
  const Column tiny = safe({1e-38f, 1e-38f, 0});
  if (tiny != Column{0, 0, 0}) {
    EXPECT_NEAR(tiny[0], std::sqrt(0.5), tolerance);
    EXPECT_NEAR(tiny[1], std::sqrt(0.5), tolerance);
    EXPECT_EQ(tiny[2], 0);
  }
}

TEST_P(GlslVector, HuntedWorstInput) {
  Probe probe(glslSources(), {{"vector.glsl"}, {}});
  for (const char* function : {"vec3 unit(vec3)", "vec3 safeUnit(vec3)"}) {
    const SearchResult worst = huntWorst(
        {{-1, 1, {0, 1e-10f}}, {0.01f, 1, {0.5f}}, {-1, 1, {0}}},
        [&](const std::vector<Column>& c) {
          Column v;
          for (std::size_t i = 0; i < c[0].size(); ++i)
            v.insert(v.end(), {c[0][i], c[1][i], c[2][i]});
          const Column got = probe.run(function, {v});
          std::vector<double> worstOf(c[0].size());
          for (std::size_t i = 0; i < v.size(); ++i)
            worstOf[i / 3] = std::max(
                worstOf[i / 3], absoluteError(got[i], safeNormalize(at(v, i / 3))[int(i % 3)]));
          return worstOf;
        },
        1 << 14, 16);
    EXPECT_LE(worst.error, tolerance) << function << describeRow({worst.input}, {3}, 0);
    if (printsErrors())
      std::printf("hunted: %s %.3g at %s\n", function, worst.error,
                  describeRow({worst.input}, {3}, 0).c_str());
  }
}

GLINT_ON_SOFTWARE_BACKENDS(GlslVector);

}  // namespace glint::glsl_vector_gl_test
