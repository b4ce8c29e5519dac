// glsl/fresnel.glsl compared with the formulas in double (src/shading), from the same indices and
// cosines.

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "glint/shading/fresnel.h"
#include "glsl_probe.h"

namespace glint::glsl_fresnel_gl_test {

struct Indices {
  double n1, n2;
};

std::vector<Indices> indices() {
  std::vector<Indices> pairs;
  for (double n : {1 + 1.2e-7, 1.00007, 1.0003, 1.01, 1.1, 1.33, 1.5, 2.4, 4.0, 100.0, 1e3}) {
    pairs.push_back({1, n});
    pairs.push_back({n, 1});
  }
  return pairs;
}

std::string nameOf(const Indices& i) {
  char text[64];
  std::snprintf(text, sizeof text, "%.9g to %.9g", i.n1, i.n2);
  return text;
}

/// The constants as the renderer passes them.
Column boundary(const FresnelConstants& k) {
  const double critical = k.e < 0 ? std::sqrt(-k.e) : 0.0;
  return {float(k.e), float(k.nSquared), float(critical), float(critical - float(critical))};
}

/// Uniform cosines, cosines concentrated near 0, 1 and the critical cosine down to single floats,
/// and the 4096 floats on each side of these.
Column cosines(const Indices& i) {
  Column column{0, -0.0f, 1};
  const double critical = criticalCosine(i.n1, i.n2);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> u(0, 1);
  const auto push = [&](double c) { column.push_back(float(std::clamp(c, 0.0, 1.0))); };
  for (int k = 0; k < 20000; ++k) {
    push(u(random));
    push(std::exp(-20 * u(random)));
    push(1 - std::exp(-18 * u(random)));
    push(critical * (1 + std::exp(-17 * u(random))));
    push(critical * (1 - std::exp(-17 * u(random))));
  }
  for (std::int64_t k = -4096; k <= 4096; ++k) {
    push(stepFloat(float(critical), k));
    push(stepFloat(1, -std::abs(k)));
  }
  return column;
}

/// The error of g = n cos(theta_t) if g^2 = `square` is off by `error`: sqrt(a) - sqrt(b) is
/// (a - b) / (sqrt(a) + sqrt(b)) and at most sqrt(a - b).
double rootError(double square, double error) {
  return square > 0 ? std::min(error / std::sqrt(square), std::sqrt(error)) : std::sqrt(error);
}

/// The bound of fresnelExact everywhere, including at the critical angle: about 12 roundings of
/// 2^-24 in amplitudes, whose squares are halved. g^2 is a product of accurate factors, so g is
/// relatively accurate, and R depends only on g.
constexpr double exactBound = 1e-6;

class GlslFresnel : public GlslTest {
 protected:
  std::optional<Probe> probe_;

  void SetUp() override {
    GlslTest::SetUp();
    probe_.emplace(glslSources(), ProbeText{{"fresnel.glsl"}, {{"DENSER_SIDE", 1}}});
  }

  Column exact(const Column& c, const Indices& i) {
    return probe_->run("float fresnelExact(float, Boundary)",
                       {c, boundary(fresnelConstants(i.n1, i.n2))});
  }
};

TEST_P(GlslFresnel, Exact) {
  for (const Indices& i : indices()) {
    const Column c = cosines(i), b = boundary(fresnelConstants(i.n1, i.n2));
    const Column got = exact(c, i);
    const ErrorRecord record = measureErrors(
        got, 1,
        [&](std::size_t row, std::size_t) { return fresnelExact(double(c[row]), i.n1, i.n2); },
        [](std::size_t, std::size_t) { return exactBound; });
    expectWithin(record, "fresnelExact " + nameOf(i), {c, b}, {1, 4});
    for (std::size_t row = 0; row < c.size(); ++row)
      ASSERT_TRUE(got[row] >= 0 && got[row] <= 1) << got[row] << " at " << c[row];
  }
}

// Where the denser side is never seen, shaders without it give the same values.
TEST_P(GlslFresnel, TheThinnerSideAloneIsTheSame) {
  Probe thinner(glslSources(), ProbeText{{"fresnel.glsl"}, {{"DENSER_SIDE", 0}}});
  for (const Indices& i : indices()) {
    if (i.n1 > i.n2) continue;
    const Column c = cosines(i), b = boundary(fresnelConstants(i.n1, i.n2)), r0{0.04f}, k{0.7f};
    const auto expectSame = [&](const char* function, std::vector<std::span<const float>> columns) {
      EXPECT_EQ(thinner.run(function, columns), probe_->run(function, columns))
          << function << " " << nameOf(i);
    };
    expectSame("float fresnelExact(float, Boundary)", {c, b});
    expectSame("float fresnelTextbook(float, Boundary)", {c, b});
    expectSame("float fresnelSchlickFifth(float, Boundary, float)", {c, b, r0});
    expectSame("float fresnelSchlickExp2(float, Boundary, float)", {c, b, r0});
    expectSame("float fresnelRational(float, Boundary, float, float)", {c, b, r0, k});
    expectSame("float refractedSquare(float, Boundary)", {c, b});
  }
}

TEST_P(GlslFresnel, Textbook) {
  // What the square under the root loses, and its effect on both amplitudes: an error d of t^2
  // (products of ratio^2 (1 - c^2), each rounded) moves t by rootError; the amplitudes move by
  // 2 n c / (c + n t)^2 and 2 n c / (n c + t)^2 times that, their squares by twice as much, halved.
  for (const Indices& i : indices()) {
    const Column c = cosines(i), b = boundary(fresnelConstants(i.n1, i.n2));
    const double n = i.n2 / i.n1;
    const Column got = probe_->run("float fresnelTextbook(float, Boundary)", {c, b});
    const ErrorRecord record = measureErrors(
        got, 1,
        [&](std::size_t row, std::size_t) { return fresnelTextbook(double(c[row]), i.n1, i.n2); },
        [&](std::size_t row, std::size_t) {
          const double x = c[row], sin2 = (1 - x * x) / (n * n), t2 = 1 - sin2;
          const double off = rootError(t2, 5 * ulp1 * (sin2 + 1 / (n * n)));
          const double t = std::max(std::sqrt(std::max(t2, 0.0)) - off, 0.0);
          const double s = x + n * t, p = n * x + t;
          if (!(s > 0 && p > 0)) return 1.0;
          return std::min(1e-6 + 2 * n * x * (1 / (s * s) + 1 / (p * p)) * off, 1.0);
        });
    expectWithin(record, "fresnelTextbook " + nameOf(i), {c, b}, {1, 4});
  }
}

TEST_P(GlslFresnel, SchlicksFamily) {
  // From the denser side, cos^2 of the refracted angle is off by 4 roundings and the division's,
  // its root by rootError; `slope` is how much the falling function magnifies that. Then, with
  // u = 2^-24:
  // - x^k by pow is exp2(k log2 x), log2 off by 2^-21 near 1 (GLSL): k 3.4e-7 x^k;
  // - x^5 by products: 5 u of x and 3 u;
  // - exp2: its argument by 4 u, itself by 3 + 2 |y| in 2^-23 (GLSL): as the Gaussian lobe, 8 u;
  // - the rational square: quotient by 4 u and the division's 5 u (GLSL), twice, and u;
  // and four more for combining it with R0: 1e-6 for the rest, 1.5e-6 with a division.
  struct Form {
    const char *name, *function;
    double parameter;  ///< exponent of pow; below 0: the k of the indices
    double (*truth)(double c, const Indices&, double parameter);
    double (*slope)(double c, double parameter);  ///< the largest from c on
    double rest;
  };
  const auto byPower = [](double c, const Indices& i, double power) {
    return schlick(c, i.n1, i.n2, power);
  };
  const auto powerSlope = [](double c, double power) {
    return power == 0 ? 0 : power * std::pow(std::clamp(1 - c, 0.0, 1.0), power - 1);
  };
  std::vector<Form> forms;
  for (double power : {0.0, 1.0, 2.5, 5.0, 20.0})
    forms.push_back({"pow", "float fresnelSchlick(float, Boundary, float, float)", power, byPower,
                     powerSlope, 1e-6 + 3.4e-7 * power});
  forms.push_back({"fifth",
                   "float fifth(float c, Boundary b, float r, float unused) "
                   "{ return fresnelSchlickFifth(c, b, r); }",
                   5, byPower, powerSlope, 1e-6});
  forms.push_back({"exp2",
                   "float power(float c, Boundary b, float r, float unused) { return "
                   "fresnelSchlickExp2(c, b, r); }",
                   0, [](double c, const Indices& i, double) { return schlickExp2(c, i.n1, i.n2); },
                   [](double c, double) {
                     return (6.98316 + 11.10946 * c) * 0.6932 *
                            std::exp2((-5.55473 * c - 6.98316) * c);
                   },
                   1e-6});
  forms.push_back({"rational", "float fresnelRational(float, Boundary, float, float)", -1,
                   [](double c, const Indices& i, double slope) {
                     return schlickRational(c, fresnelConstants(i.n1, i.n2), slope);
                   },
                   [](double c, double slope) {
                     const double low = 1 + slope * c;
                     return 2 * (1 + slope) / (low * low * low);
                   },
                   1.5e-6});
  for (const Indices& i : indices())
    for (const Form& form : forms) {
      const FresnelConstants constants = fresnelConstants(i.n1, i.n2);
      const double k = form.parameter < 0 ? rationalMinimax(i.n1, i.n2) : form.parameter;
      const Column c = cosines(i), b = boundary(constants), r0{float(constants.r0)},
                   parameter{float(k)};
      const Column got = probe_->run(form.function, {c, b, r0, parameter});
      const ErrorRecord record = measureErrors(
          got, 1, [&](std::size_t row, std::size_t) { return form.truth(double(c[row]), i, k); },
          [&](std::size_t row, std::size_t) {
            double off = ulp1, t = c[row];
            if (i.n1 > i.n2) {
              const double cos2 = (constants.e + t * t) / constants.nSquared;
              off = rootError(cos2, 4 * ulp1);
              t = std::sqrt(std::max(cos2, 0.0));
            }
            return form.rest + form.slope(std::max(t - off, 0.0), k) * off;
          });
      expectWithin(record, std::string(form.name) + " " + std::to_string(k) + " " + nameOf(i),
                   {c, b, r0, parameter}, {1, 4, 1, 1});
      for (float value : got) ASSERT_TRUE(value >= 0 && value <= 1 + 1e-6f) << value;
    }
}

TEST_P(GlslFresnel, EqualIndicesReflectNothing) {  // K1, K2
  Column c{0, -0.0f, 1, -1, 2};
  for (int k = 0; k < 10000; ++k) c.push_back(std::exp(-20 * float(k) / 10000));
  const Column nothing(c.size(), 0.0f);
  const Column b = boundary(fresnelConstants(1.5, 1.5)), zero{0}, five{5};
  EXPECT_EQ(probe_->run("float fresnelExact(float, Boundary)", {c, b}), nothing);
  EXPECT_EQ(probe_->run("float fresnelTextbook(float, Boundary)", {c, b}), nothing);
  EXPECT_EQ(probe_->run("float fresnelSchlick(float, Boundary, float, float)", {c, b, zero, five}),
            nothing);
  EXPECT_EQ(probe_->run("float fresnelSchlickFifth(float, Boundary, float)", {c, b, zero}),
            nothing);
  EXPECT_EQ(probe_->run("float fresnelSchlickExp2(float, Boundary, float)", {c, b, zero}), nothing);
  EXPECT_EQ(probe_->run("float fresnelRational(float, Boundary, float, float)", {c, b, zero, zero}),
            nothing);
}

TEST_P(GlslFresnel, CosinesOutsideTheRange) {
  // K5, K6, K7, K8: values below 0 count as 0, where R is 1; values above 1 as 1.
  const Column c{0, -0.0f, -0.2f, -1, stepFloat(0, -1), 1, stepFloat(1, 1), 1.5f, 1e30f};
  for (const Indices& i : indices()) {
    const double r0 = fresnelConstants(i.n1, i.n2).r0;
    const Column b = boundary(fresnelConstants(i.n1, i.n2)), normal{float(r0)}, five{5},
                 slope{2.2f};
    for (const Column& r :
         {probe_->run("float fresnelExact(float, Boundary)", {c, b}),
          probe_->run("float fresnelTextbook(float, Boundary)", {c, b}),
          probe_->run("float fresnelSchlickFifth(float, Boundary, float)", {c, b, normal}),
          probe_->run("float fresnelRational(float, Boundary, float, float)",
                      {c, b, normal, slope}),
          probe_->run("float fresnelSchlick(float, Boundary, float, float)",
                      {c, b, normal, five})}) {
      for (std::size_t k = 0; k < 5; ++k) EXPECT_NEAR(r[k], 1, 2e-6) << nameOf(i) << " " << c[k];
      for (std::size_t k = 5; k < 9; ++k) {
        EXPECT_NEAR(r[k], r0, 2e-6) << nameOf(i) << " " << c[k];
        EXPECT_EQ(r[k], r[5]) << nameOf(i) << " " << c[k];
      }
    }
  }
}

TEST_P(GlslFresnel, TotalReflection) {  // K9, K10, K11
  for (const Indices& i : indices()) {
    if (i.n1 < i.n2) continue;
    const double critical = criticalCosine(i.n1, i.n2);
    // A relative 1e-6 past the critical cosine squared is more than g^2's rounding.
    const Column c{0.0f, float(critical * 0.5), float(critical * (1 - 1e-3))};
    // For index ratios above 50, rounding c may already move it to the other side.
    if (i.n1 / i.n2 < 50) {
      EXPECT_EQ(exact(c, i), (Column{1, 1, 1})) << nameOf(i);
    }
    const Column at{stepFloat(float(critical), -1), float(critical), stepFloat(float(critical), 1)};
    const Column r = exact(at, i);
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_NEAR(r[k], fresnelExact(double(at[k]), i.n1, i.n2), 2e-3) << nameOf(i);
  }
}

TEST_P(GlslFresnel, Brewster) {  // K12: R is half of R_perp, 0.0739645 at n = 1.5
  const double c = std::cos(brewsterAngle(1, 1.5));
  EXPECT_NEAR(exact({float(c)}, {1, 1.5})[0], 0.5 * std::pow(1.25 / 3.25, 2), 2e-7);
}

TEST_P(GlslFresnel, ExtremeIndicesStayFinite) {  // K13
  for (double n : {1e-4, 1e4, 1e-9, 1e9}) {
    const Indices i{1, n};
    for (float r : exact(cosines(i), i)) ASSERT_TRUE(r >= 0 && r <= 1) << n << ": " << r;
  }
}

TEST_P(GlslFresnel, Reciprocity) {  // K17: R(1 -> n, theta_i) = R(n -> 1, theta_t)
  for (double n : {1.0003, 1.1, 1.5, 2.4, 4.0, 100.0}) {
    Column inside, outside;
    for (int k = 0; k < 20000; ++k) {
      const double ci = 0.1 + 0.9 * (k + 0.5) / 20000;
      outside.push_back(float(ci));
      const double x = outside.back();
      inside.push_back(float(std::sqrt(1 - (1 - x * x) / (n * n))));
    }
    const Column in = exact(outside, {1, n}), out = exact(inside, {n, 1});
    for (std::size_t k = 0; k < in.size(); ++k) {
      // cos(theta_t) is rounded by 2^-25. R's slope with respect to it is the slope with respect to
      // cos(theta_i) times n^2 cos(theta_t) / cos(theta_i).
      const double ci = outside[k], ct = inside[k], h = 1e-4;
      const double slope = (fresnelExact(ci - h, 1, n) - fresnelExact(ci + h, 1, n)) / (2 * h);
      const double rounding = std::abs(slope) * n * n * ct / ci * 0.5 * ulp1;
      ASSERT_NEAR(in[k], out[k], 2e-6 + 2 * rounding) << n << " at " << ci;
    }
  }
}

TEST_P(GlslFresnel, HuntedWorstInput) {
  // Searches over cosine and index together, by the ratio of error to bound.
  for (bool denser : {false, true}) {
    double largest = 0;
    const SearchResult worst = huntWorst(
        {{0, 1, {1e-4f, 0.7071068f, 0.745356f}}, {1.0000001f, 1e3f, {1.1f, 1.5f, 2}}},
        [&](const std::vector<Column>& columns) {
          Column b;
          std::vector<Indices> pairs;
          for (float n : columns[1]) {
            pairs.push_back(denser ? Indices{n, 1} : Indices{1, n});
            const Column one = boundary(fresnelConstants(pairs.back().n1, pairs.back().n2));
            b.insert(b.end(), one.begin(), one.end());
          }
          const Column& c = columns[0];
          const Column got = probe_->run("float fresnelExact(float, Boundary)", {c, b});
          std::vector<double> errors;
          for (std::size_t k = 0; k < c.size(); ++k) {
            const double error =
                absoluteError(got[k], fresnelExact(double(c[k]), pairs[k].n1, pairs[k].n2));
            errors.push_back(error / exactBound);
            largest = std::max(largest, error);
          }
          return errors;
        },
        1 << 14, 24);
    EXPECT_LE(worst.error, 1) << describeRow({worst.input}, {2}, 0);
    if (printsErrors())
      std::printf("hunted: fresnelExact %s %.3g of the bound at %s, largest error %.3g\n",
                  denser ? "from the denser side" : "from the thinner side", worst.error,
                  describeRow({worst.input}, {2}, 0).c_str(), largest);
  }
}

GLINT_ON_SOFTWARE_BACKENDS(GlslFresnel);

}  // namespace glint::glsl_fresnel_gl_test
