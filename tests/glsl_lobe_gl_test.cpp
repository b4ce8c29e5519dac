// glsl/lobe.glsl compared with double, for every float where that is possible and by search
// otherwise.

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>
#include <optional>

#include "glint/shading/forms.h"
#include "glint/shading/lobe.h"
#include "glsl_probe.h"

namespace glint::glsl_lobe_gl_test {

constexpr double exponents[] = {0, 0.5, 1, 2, 10, 40, 100, 1e3, 1e4, 1e5, 1e6};

constexpr const char* phong =
    "float phong(vec3 n, vec3 l, vec3 v, float a) {\n"
    "  return lobeExact(phongLambda(n, l + v, dot(n, l)), a);\n}";
constexpr const char* blinn =
    "float blinn(vec3 n, vec3 l, vec3 v, float a) {\n"
    "  return lobeExact(blinnLambda(n, unit(l + v)), a);\n}";
// From vectors of any length, as in the programs.
constexpr const char* wholePhong =
    "float whole(vec3 n, vec3 l, vec3 v, float a) {\n"
    "  vec3 un = unit(n), ul = unit(l), uv = unit(v);\n"
    "  return lobeExact(phongLambda(un, ul + uv, dot(un, ul)), a);\n}";
constexpr const char* wholeBlinn =
    "float whole(vec3 n, vec3 l, vec3 v, float a) {\n"
    "  vec3 un = unit(n), ul = unit(l), uv = unit(v);\n"
    "  return lobeExact(blinnLambda(un, unit(ul + uv)), a);\n}";

// The lobe is exp(-t) with t = -alpha log(1 - lambda), at least alpha lambda. There are two errors:
// - of lambda: |D| = sqrt(2 lambda), so an error d of D moves lambda by |D| d and the lobe by
//   alpha |D| d exp(-t) <= sqrt(alpha) d sqrt(2t) exp(-t) <= 0.61 sqrt(alpha) d. D's components are
//   sums of three terms of at most 2, rounded at each step: d <= 6.5e-7, so 4e-7 sqrt(alpha).
// - of the power: t's relative error r, from log1m (6e-7, below) and two products, moves the lobe
//   by t exp(-t) r <= 0.37 r; exp2(x) is off by at most 3 + 2 |x| in 2^-23 of its value (GLSL),
//   with the value 2^-|x| by 3.6e-7. Together at most 1e-6.
double bound(double alpha) { return 1e-6 + 4e-7 * std::sqrt(alpha); }

// Below exponent 1 the lobe ends at lambda = 1 with infinite slope, at exponent 0 with a jump:
// there it is as ill-conditioned as (1 - lambda)^alpha, with lambda off by |D| d.
double edge(double lambda, double alpha, double d) {
  if (alpha >= 1 || lambda < 0.5) return 0;
  const double off = std::sqrt(2 * lambda) * d, x = 1 - lambda;
  if (x <= -off) return 0;
  return std::pow(x + off, alpha) - (x > off ? std::pow(x - off, alpha) : 0.0);
}

double exactLobe(double lambda, double alpha) {
  return lambda < 1 ? std::exp(alpha * std::log1p(-lambda)) : 0.0;
}

struct Directions {
  Column n, l, v;
  Columns columns(const Column& alpha) const { return {n, l, v, alpha}; }
  static glm::dvec3 at(const Column& column, std::size_t row) {
    return {column[3 * row], column[3 * row + 1], column[3 * row + 2]};
  }
  glm::dvec3 normal(std::size_t row) const { return at(n, row); }
  glm::dvec3 light(std::size_t row) const { return at(l, row); }
  glm::dvec3 view(std::size_t row) const { return at(v, row); }
};

glm::dvec3 randomUnit(std::mt19937& random) {
  std::normal_distribution<double> normal;
  for (;;) {
    const glm::dvec3 v(normal(random), normal(random), normal(random));
    if (glm::length(v) > 1e-3) return glm::normalize(v);
  }
}

void push(Column& column, const glm::dvec3& v) {
  for (int i = 0; i < 3; ++i) column.push_back(float(v[i]));
}

/// V around the peak: half with alpha lambda uniform in [0, 8], a quarter at or next to lambda 0, 1
/// and 2, a quarter anywhere. Blinn's lobe has its peak at the same V. The vectors are rounded unit
/// vectors, scaled by up to e^spread.
Directions directions(double alpha, std::size_t rows, bool isBlinn, double spread) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> u(0, 1);
  Directions d;
  for (std::size_t i = 0; i < rows; ++i) {
    const glm::dvec3 n = randomUnit(random);
    glm::dvec3 l = randomUnit(random);
    if (glm::dot(n, l) < 0) l = -l;
    if (i % 8 == 0) l = n;
    const glm::dvec3 axis = isBlinn ? n : 2 * glm::dot(n, l) * n - l;
    double lambda = 2 * u(random);
    if (i % 4 < 2) lambda = std::min(8 * u(random) / std::max(alpha, 1e-9), 2.0);
    if (i % 4 == 2) {
      const double special[] = {0, 1, 2};
      lambda = special[i / 4 % 3] + std::exp(-20 * u(random)) * (u(random) - 0.5);
      lambda = std::clamp(lambda, 0.0, 2.0);
    }
    const glm::dvec3 side = glm::normalize(glm::cross(axis, randomUnit(random)));
    const double c = 1 - lambda;
    const glm::dvec3 at = c * axis + std::sqrt(std::max(1 - c * c, 0.0)) * side;
    const glm::dvec3 v = isBlinn ? 2 * glm::dot(at, l) * at - l : at;
    const auto scale = [&] { return std::exp(spread * (2 * u(random) - 1)); };
    push(d.n, scale() * n);
    push(d.l, scale() * l);
    push(d.v, scale() * v);
  }
  return d;
}

class GlslLobe : public GlslTest {
 protected:
  std::optional<Probe> probe_;

  void SetUp() override {
    GlslTest::SetUp();
    probe_.emplace(glslSources(), ProbeText{{"vector.glsl", "lobe.glsl"}, {}});
  }

  /// Compares the lobe of these directions with its value in double; with `whole`, that normalises
  /// first.
  void expectGeometry(const std::string& name, const char* function, const Directions& d,
                      double alpha, bool isBlinn, bool whole) {
    const Column exponent{float(alpha)};
    const Columns columns = d.columns(exponent);
    const Column got = probe_->run(function, columns);
    std::vector<double> lambdas, conditions;
    for (std::size_t row = 0; row < got.size(); ++row) {
      glm::dvec3 n = d.normal(row), l = d.light(row), v = d.view(row);
      if (whole) n = glm::normalize(n), l = glm::normalize(l), v = glm::normalize(v);
      lambdas.push_back(isBlinn ? blinnLambda(n, l, v) : phongLambda(n, l, v));
      conditions.push_back(isBlinn && whole ? 2 / glm::length(l + v) : 1);
    }
    const ErrorRecord record = measureErrors(
        got, 1,
        [&](std::size_t row, std::size_t) { return exactLobe(lambdas[row], double(exponent[0])); },
        [&](std::size_t row, std::size_t) {
          return bound(alpha) * conditions[row] +
                 edge(lambdas[row], alpha, 6.5e-7 * conditions[row]);
        });
    expectWithin(record, name + " alpha " + std::to_string(alpha), columns, {3, 3, 3, 1});
  }
};

TEST_P(GlslLobe, Log1mIsRelativelyExact) {
  // Below 1/2: s is off by 2 roundings and the division's (2.5 in 2^-23, GLSL; 0.5 here), the
  // series by 3 and its truncation (1.5e-7), then two products: 5.5e-7. Above: 1 - x is exact, log2
  // is off by 3 in 2^-23 (GLSL), then a constant and a product: 4.8e-7. Subnormal numbers may count
  // as 0, including s = x / 2.
  const double relative = 6e-7;
  Column x;
  const std::int32_t one = floatOrder(1.0f), half = floatOrder(0.5f);
  for (std::int32_t i = 0; i < one; i += 1021) x.push_back(floatAtOrder(i));
  for (std::int32_t i = 1; i <= 1 << 18; ++i) {
    x.push_back(floatAtOrder(one - i));
    x.push_back(floatAtOrder(half - (1 << 17) + i));
  }
  for (std::int32_t i = floatOrder(0.01f); i < one; i += 61) x.push_back(floatAtOrder(i));
  const auto truth = [&](std::size_t row, std::size_t) { return std::log1p(-double(x[row])); };
  const ErrorRecord record = measureErrors(
      probe_->run("float log1m(float)", {x}), 1, truth, [&](std::size_t row, std::size_t) {
        return relative * std::abs(truth(row, 0)) + std::ldexp(1.0, -125);
      });
  expectWithin(record, "log1m", {x}, {1});
}

TEST_P(GlslLobe, PowerOfLambda) {
  for (double alpha : exponents) {
    Column lambda{0, stepFloat(1, -1), 1, stepFloat(1, 1), 2, 0.5f, stepFloat(0.5f, 1)};
    std::mt19937 random(3);
    std::uniform_real_distribution<double> u(0, 1);
    for (int i = 0; i < 50000; ++i) {
      lambda.push_back(float(std::min(8 * u(random) / std::max(alpha, 1e-9), 2.0)));
      lambda.push_back(float(2 * u(random)));
      lambda.push_back(floatAtOrder(std::int32_t(floatOrder(1.0f) * u(random))));
    }
    const Column exponent{float(alpha)};
    const Columns columns{lambda, exponent};
    const Column got = probe_->run("float lobeExact(float, float)", columns);
    const ErrorRecord record = measureErrors(
        got, 1,
        [&](std::size_t row, std::size_t) { return exactLobe(lambda[row], double(exponent[0])); },
        [](std::size_t, std::size_t) { return 1e-6; });
    expectWithin(record, "lobeExact(lambda) alpha " + std::to_string(alpha), columns, {1, 1});
    for (float value : got) ASSERT_TRUE(value >= 0 && value <= 1) << value;
  }
}

TEST_P(GlslLobe, FromRoundedUnitVectors) {
  for (double alpha : exponents) {
    expectGeometry("Phong", phong, directions(alpha, 30000, false, 0), alpha, false, false);
    expectGeometry("Blinn", blinn, directions(alpha, 30000, true, 0), alpha, true, false);
  }
}

TEST_P(GlslLobe, FromVectorsOfAnyLength) {
  // Normalised by unit() here and in double there. unit() turns a vector by at most 1.5e-7, which
  // is within the same d: once for V and L, twice for N. The half vector turns by that over half
  // the length of L + V, which is the cosine of incidence at the peak.
  for (double alpha : exponents) {
    expectGeometry("whole Phong", wholePhong, directions(alpha, 30000, false, 5), alpha, false,
                   true);
    expectGeometry("whole Blinn", wholeBlinn, directions(alpha, 30000, true, 5), alpha, true, true);
  }
}

TEST_P(GlslLobe, SpecialCases) {
  const float last = stepFloat(1, -1), infinity = std::numeric_limits<float>::infinity();
  const Column lambda{0, 0, 0, last, last, 1, 1, 2, 2, infinity, infinity, 0.25f};
  const Column alpha{0, 1, 1e6f, 0, 1e6f, 0, 1, 0, 1, 0, 1e6f, 0};
  EXPECT_EQ(probe_->run("float lobeExact(float, float)", {lambda, alpha}),
            (Column{1, 1, 1, 1, 0, 0, 0, 0, 0, 0, 0, 1}));
  // Exponent 0 gives 1 where the cosine is positive and 0 elsewhere. Nothing exceeds the peak, even
  // if the cosine of rounded vectors exceeds 1.
  const Column cosine{0, -0.0f, -0.5f, -1, 1, 1, 1e-30f, 1e-30f, stepFloat(1, 1), 1.001f};
  const Column power{0, 0, 2.5f, 0, 0, 1e6f, 0, 2, 1e6f, 1e6f};
  EXPECT_EQ(probe_->run("float lobePow(float, float)", {cosine, power}),
            (Column{0, 0, 0, 0, 1, 1, 1, 0, 1, 1}));
}

TEST_P(GlslLobe, Pow) {
  for (double alpha : exponents) {
    Column cosine{0, stepFloat(1, -1), 1};
    std::mt19937 random(3);
    std::uniform_real_distribution<double> u(0, 1);
    for (int i = 0; i < 50000; ++i) {
      cosine.push_back(float(std::exp(-8 * u(random) / std::max(alpha, 1e-9))));
      cosine.push_back(float(2 * u(random) - 1));
    }
    const Column exponent{float(alpha)};
    const Columns columns{cosine, exponent};
    const ErrorRecord record = measureErrors(
        probe_->run("float lobePow(float, float)", columns), 1,
        [&](std::size_t row, std::size_t) { return lobePow(cosine[row], double(exponent[0])); },
        // log2 may be off by 2^-21 near 1 (GLSL), and the lobe by alpha log(2) times that.
        [&](std::size_t, std::size_t) { return std::min(1e-6 + 3.4e-7 * alpha, 1.0); });
    expectWithin(record, "lobePow alpha " + std::to_string(alpha), columns, {1, 1});
  }
}

TEST_P(GlslLobe, HuntedWorstInput) {
  const SearchResult power = huntWorst(
      {{0, 2, {0.5f, 1}}, {0, 1e6f, {0.5f, 1, 2, 10, 1e3f}}},
      [&](const std::vector<Column>& c) {
        const Column got = probe_->run("float lobeExact(float, float)", {c[0], c[1]});
        std::vector<double> errors;
        for (std::size_t i = 0; i < got.size(); ++i)
          errors.push_back(absoluteError(got[i], exactLobe(c[0][i], c[1][i])));
        return errors;
      },
      1 << 15, 16);
  EXPECT_LE(power.error, 1e-6) << describeRow({power.input}, {2}, 0);

  const SearchResult log = huntWorst(
      {{1e-37f, stepFloat(1, -1), {0.5f}}},
      [&](const std::vector<Column>& c) {
        const Column got = probe_->run("float log1m(float)", {c[0]});
        std::vector<double> errors;
        for (std::size_t i = 0; i < got.size(); ++i)
          errors.push_back(std::abs(got[i] / std::log1p(-double(c[0][i])) - 1));
        return errors;
      },
      1 << 15, 16);
  EXPECT_LE(log.error, 6e-7) << describeRow({log.input}, {1}, 0);
  if (printsErrors())
    std::printf("hunted: lobeExact %.3g at %s\n        log1m %.3g at %s\n", power.error,
                describeRow({power.input}, {2}, 0).c_str(), log.error,
                describeRow({log.input}, {1}, 0).c_str());
}

// The approximate forms of the lobe, from the same lambda, with u = 2^-24, the rounding of one
// operation. They share a base b in [0, 1] raised to a power p by squaring: an error d of b moves
// b^p by p b^(p-1) d, and the squarings by (p - 1) u b^p.
TEST_P(GlslLobe, FormsBySquaring) {
  struct Case {
    std::string name, function;
    Highlight form;
    int gamma;
    double alpha;
    Column first, second;  ///< computed on the CPU
  };
  std::vector<Case> cases;
  const auto call = [](const char* function, const std::string& arguments, int power) {
    return "float form(float x, float a, float b) { return " + std::string(function) + "(x, " +
           arguments + std::to_string(power) + "); }";
  };
  for (double alpha : {1.0, 2.0, 3.0, 7.0, 20.0, 127.0, 128.0})
    cases.push_back({"integer",
                     call("lobeInteger", "", int(alpha)),
                     Highlight::integer,
                     int(alpha),
                     alpha,
                     {0},
                     {0}});
  for (int gamma : {1, 2, 4, 8, 16, 32, 64})
    for (double alpha : {0.5, 1.0, 10.0, 64.0, 1e3, 1e6}) {
      const double beta = alpha / gamma;
      cases.push_back({"lyon",
                       call("lobeLyon", "a, ", gamma),
                       Highlight::lyon,
                       gamma,
                       alpha,
                       {float(beta)},
                       {0}});
      cases.push_back({"lyon-tuned",
                       call("lobeLyon", "a, ", gamma),
                       Highlight::lyonTuned,
                       gamma,
                       alpha,
                       {float(tunedSlope(alpha, gamma))},
                       {0}});
      cases.push_back({"lyon-cross",
                       call("lobeLyonCross", "a, ", gamma),
                       Highlight::lyonCross,
                       gamma,
                       alpha,
                       {float(beta / 2)},
                       {0}});
      cases.push_back({"pade",
                       call("lobePade", "a, b, ", gamma),
                       Highlight::pade,
                       gamma,
                       alpha,
                       {float(1 + beta)},
                       {float(beta - 1)}});
    }
  for (const Case& each : cases) {
    Column lambda{0, stepFloat(1, -1), 1, stepFloat(1, 1), stepFloat(2, -1), 2, 0.5f};
    std::mt19937 random(3);
    std::uniform_real_distribution<double> v(0, 1);
    for (int i = 0; i < 3000; ++i) {
      lambda.push_back(float(std::min(8 * v(random) / each.alpha, 2.0)));
      lambda.push_back(float(2 * v(random)));
      lambda.push_back(floatAtOrder(std::int32_t(floatOrder(1.0f) * v(random))));
    }
    const Columns columns{lambda, each.first, each.second};
    const Column got = probe_->run(each.function, columns);
    const double u = ulp1, g = each.gamma, beta = each.alpha / g;
    const auto bound = [&](std::size_t row, std::size_t) {
      const double x = lambda[row];
      double base = 1 - (each.form == Highlight::integer ? 1 : beta) * x, off = 3 * u;
      // b = 1 - y with y <= 1: y has 2 products (4 with the cross product), then one difference.
      if (each.form == Highlight::lyonTuned) base = 1 - tunedSlope(each.alpha, each.gamma) * x;
      if (each.form == Highlight::lyonCross) base = 1 - 0.5 * beta * x * (2 - x), off = 5 * u;
      if (each.form == Highlight::pade) {
        // Each side has 2 products and a sum, the division 2.5 in 2^-23 (GLSL).
        const double top = 2 - (1 + beta) * x, bottom = 2 + (beta - 1) * x;
        base = top / bottom;
        off = (2 * u * (1 + beta) * x + u * std::abs(top) +
               base * (2 * u * std::abs(beta - 1) * x + u * bottom)) /
                  bottom +
              5 * u * base;
        if (!(bottom > 0 && off >= 0)) off = 0, base = std::max(std::min(base, 1.0), 0.0);
      }
      const double most = std::clamp(base + off, 0.0, 1.0);
      return g * std::pow(most, g - 1) * off + g * u * std::pow(most, g) + 1e-37;
    };
    const ErrorRecord record = measureErrors(
        got, 1,
        [&](std::size_t row, std::size_t) {
          return lobe(each.form, each.gamma, lambda[row], each.alpha);
        },
        bound);
    expectWithin(
        record,
        each.name + ":" + std::to_string(each.gamma) + " alpha " + std::to_string(each.alpha),
        columns, {1, 1, 1});
    for (float value : got) ASSERT_TRUE(value >= 0 && value <= 1 + 64 * 6e-8) << value;
  }
}

TEST_P(GlslLobe, Gaussian) {
  // y = rate lambda is off by 2 u, exp2(-y) by 3 + 2 y in 2^-23 of its value (GLSL): together at
  // most the max over y of 2^-y (2 u y log 2 + 2 u (3 + 2 y)) = 6.3 u.
  for (double alpha : exponents) {
    if (alpha == 0) continue;
    Column lambda{0, 1, 2, stepFloat(2, 1), 0.5f};
    std::mt19937 random(3);
    std::uniform_real_distribution<double> v(0, 1);
    for (int i = 0; i < 20000; ++i) {
      lambda.push_back(float(std::min(8 * v(random) / alpha, 2.0)));
      lambda.push_back(float(2 * v(random)));
    }
    const Column rate{float((alpha + gaussianShift) / std::log(2.0))};
    const Columns columns{lambda, rate};
    const Column got = probe_->run("float lobeGaussian(float, float)", columns);
    const ErrorRecord record = measureErrors(
        got, 1, [&](std::size_t row, std::size_t) { return gaussian(lambda[row], alpha); },
        [](std::size_t, std::size_t) { return 6.5 * ulp1; });
    expectWithin(record, "lobeGaussian alpha " + std::to_string(alpha), columns, {1, 1});
    for (float value : got) ASSERT_TRUE(value >= 0 && value <= 1) << value;
  }
}

GLINT_ON_SOFTWARE_BACKENDS(GlslLobe);

}  // namespace glint::glsl_lobe_gl_test
