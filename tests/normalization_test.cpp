// Energy-preserving highlights: the factors compared with integrals of the sum's own highlight.

#include "glint/shading/normalization.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "glint/shading/specular_filter.h"
#include "glint/shading/sum.h"

namespace glint {
namespace normalization_test {

using std::numbers::pi;

constexpr double exponents[] = {0, 0.5, 1, 4, 10, 40, 160, 1e3, 1e4, 1e6};

SumParameters parametersFor(double exponent, Normalization kind) {
  SumParameters p;
  p.diffuse = 0;
  p.specular = 1;
  p.exponent = exponent;  // of the lobe, also Blinn-Phong's
  p.blinnFactor = 1;
  p.normalization = kind;
  return p;
}

double highlight(const SumParameters& p, bool blinn, const glm::dvec3& L, const glm::dvec3& V) {
  const glm::dvec3 N(0, 0, 1);
  return (blinn ? blinnPhongLight : phongLight)(p, N, L, V, glm::dvec3(1.0)).specular.x;
}

/// Simpson's rule over [a, b].
template <class F>
double integral(double a, double b, int cells, F f) {
  double sum = f(a) + f(b);
  for (int i = 1; i < 2 * cells; ++i)
    sum += (i % 2 == 1 ? 4 : 2) * f(a + (b - a) * i / (2 * cells));
  return sum * (b - a) / (6 * cells);
}

/// The radiance that a surface with the normal +Z reflects in a furnace of radiance 1, towards V at
/// the angle `view` from the normal: 1/pi times the integral of the highlight over all L with
/// N.L > 0. A white diffuse surface reflects 1/pi times the integral of N.L, which is 1. Integrated
/// around the lobe's axis, with the angle a as 1 - cos a = exp(y), so that lobes of every width get
/// enough steps.
double furnace(const SumParameters& p, bool blinn, double view) {
  const glm::dvec3 V(std::sin(view), 0, std::cos(view));
  const glm::dvec3 axis = blinn ? glm::dvec3(0, 0, 1) : glm::dvec3(-V.x, 0, V.z);
  const glm::dvec3 across(axis.z, 0, -axis.x);
  const int rings = 300, around = view == 0 ? 1 : 120;
  const auto ring = [&](double y) {
    const double c = 1 - std::exp(y), s = std::sqrt(std::max(1 - c * c, 0.0));
    const auto at = [&](double turn) {
      const glm::dvec3 d =
          c * axis + s * (std::cos(turn) * across + std::sin(turn) * glm::dvec3(0, 1, 0));
      // For Blinn-Phong, d is H: dL = 4 V.H dH.
      const glm::dvec3 L = blinn ? 2 * glm::dot(V, d) * d - V : d;
      const double measure = blinn ? 4 * std::max(glm::dot(V, d), 0.0) : 1;
      return L.z > 0 ? measure * highlight(p, blinn, L, V) : 0;
    };
    const double whole = around == 1 ? pi * at(0.5) : integral(0, pi, around, at);
    return 2 * whole * std::exp(y);
  };
  return integral(std::log(1e-13), -1e-12, rings, ring) / pi;
}

/// Simpson's error for the smooth integrand along the normal is far below 1e-5, except that Phong's
/// lobe with an exponent below 1 ends with infinite slope.
double phongsError(double n) { return n > 0 && n < 1 ? 2e-3 : 1e-5; }

// Blinn-Phong's lobe ends with a jump at H 45 degrees from N, where L is on the horizon: a ring is
// 0.05 wide in y there, and the lobe has fallen to at most 2^(-n/2).
TEST(Normalization, ExactShowsTheShareInAFurnaceAlongTheNormal) {
  for (const double n : exponents) {
    const auto p = parametersFor(n, Normalization::exact);
    EXPECT_NEAR(furnace(p, false, 0), 1, phongsError(n)) << n;
    EXPECT_NEAR(furnace(p, true, 0), 1, 1e-5 + 0.06 * std::exp2(-n / 2)) << n;
  }
}

// The notes' formula, without normalisation, reflects less and less.
TEST(Normalization, WithoutItTheLightIsThatOfTheLobesSize) {
  for (const double n : exponents)
    EXPECT_NEAR(furnace(parametersFor(n, Normalization::none), false, 0) * (n + 1) / 2, 1,
                phongsError(n));
}

// Phong's is at least half, the part of a lobe on the horizon that is above it. Blinn-Phong's
// decreases towards the cosine. Neither reflects more than along the normal. (The gate N.L > 0 cuts
// through cells of the integral: 1e-2.)
TEST(Normalization, ExactShowsNoMoreFromTheSide) {
  for (const double n : {0.0, 1.0, 10.0, 40.0, 1e3}) {
    const auto p = parametersFor(n, Normalization::exact);
    double before[] = {1.0, 1.0};
    for (const double degrees : {20.0, 40.0, 60.0, 80.0, 90.0}) {
      const double view = degrees * pi / 180;
      for (const bool blinn : {false, true}) {
        const double shown = furnace(p, blinn, view);
        EXPECT_LE(shown, before[blinn] + 1e-2) << n << " " << degrees << " " << blinn;
        before[blinn] = shown;
        if (!blinn) {
          EXPECT_GE(shown, 0.5 - 5e-3) << n << " " << degrees;
        } else if (n >= 1e3 && degrees <= 60) {
          EXPECT_NEAR(shown, std::cos(view), 0.02) << degrees;
        }
      }
    }
    EXPECT_NEAR(before[0], 0.5, 0.01) << n;
  }
}

// With N.L, which the literature includes and the sum does not: 2 pi / (n + 2) for the lobe's
// cosine-weighted integral.
TEST(Normalization, SimpleIsThatOfTheLiterature) {
  for (const double n : exponents) {
    const double phong = lobeNormalization(Normalization::simple, false, n) / pi;
    EXPECT_NEAR(phong * 2 * pi / (n + 2), 1, 1e-14);
    EXPECT_DOUBLE_EQ(lobeNormalization(Normalization::simple, true, n), (n + 8) / 8);
    for (const bool blinn : {false, true}) {
      const double over = lobeNormalization(Normalization::simple, blinn, n) /
                          lobeNormalization(Normalization::exact, blinn, n);
      EXPECT_GT(over, 1 - 1e-12) << n;
      EXPECT_LE(over, 2 + 1e-12) << n;
    }
  }
  EXPECT_EQ(lobeNormalization(Normalization::none, true, 40), 1);
}

TEST(Normalization, IsFiniteForEveryExponent) {
  for (const double n : {-1.0, std::nan(""), 1e300, HUGE_VAL, 0.0})
    for (const auto kind : {Normalization::none, Normalization::simple, Normalization::exact})
      for (const bool blinn : {false, true}) {
        const double k = lobeNormalization(kind, blinn, n);
        EXPECT_GE(k, 0.5) << n;
        EXPECT_LE(k, 1e9) << n;
      }
}

// a^2 = 2 / (n + 2) increases by 2 s^2 T, by at most 0.18, and not beyond 1. The peak falls by the
// same factor, so that the light of the distribution (n + 2) / (2 pi) (N.H)^n is unchanged.
TEST(SpecularFilter, WidensByTheTurnAndKeepsTheLight) {
  EXPECT_DOUBLE_EQ(pixelVariance, 1 / (2 * pi));
  for (const double n : exponents)
    for (const double turn : {0.0, 1e-6, 1e-3, 0.1, 10.0}) {
      const FilteredLobe f = filteredLobe(n, true, turn);
      const double before = 2 / (n + 2), after = 2 / (f.exponent + 2);
      EXPECT_NEAR(after, std::min(before + std::min(turn / pi, 0.18), 1.0), 1e-12)
          << n << " " << turn;
      EXPECT_NEAR(f.scale, (f.exponent + 2) / (n + 2), 1e-12);
      // Phong's exponent is a quarter of Blinn-Phong's.
      const FilteredLobe phong = filteredLobe(n / 4, false, turn);
      EXPECT_NEAR(4 * phong.exponent, f.exponent, 1e-9 * (1 + n));
      EXPECT_DOUBLE_EQ(phong.scale, f.scale);
    }
  EXPECT_DOUBLE_EQ(filteredLobe(1e6, true, 1e9).exponent, 2 / (2 / (1e6 + 2) + 0.18) - 2);
}

TEST(SpecularFilter, IsFiniteForEveryInput) {
  for (const double n : {-1.0, std::nan(""), HUGE_VAL, 0.0, 40.0})
    for (const double turn : {-1.0, std::nan(""), HUGE_VAL, 0.0, 1.0}) {
      const FilteredLobe f = filteredLobe(n, false, turn);
      EXPECT_TRUE(f.exponent >= 0 && f.exponent <= 1e9) << n << " " << turn;
      EXPECT_TRUE(f.scale > 0 && f.scale <= 1) << n << " " << turn;
    }
}

}  // namespace normalization_test
}  // namespace glint
