#include "glint/shading/fresnel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/multiprecision/cpp_dec_float.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

namespace glint::fresnel_test {

using glm::dvec3;

using Real = boost::multiprecision::cpp_dec_float_100;

constexpr double u = 0x1p-53;  // unit roundoff
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double degree = std::numbers::pi / 180.0;

struct Truth {
  Real perpendicular, parallel, r, g;
};

/// Fresnel's textbook equations in 100 digits for exactly these doubles; g = n cos(theta_t), 0 in
/// total reflection. A form different from the one under test; its cancellation loses at most 34
/// digits for the inputs used here.
Truth truth(double cosTheta, double n1, double n2) {
  const Real c = cosTheta, a = n1, b = n2;
  if (n1 == n2) return {0, 0, 0, c};
  const Real cos2t = 1 - (a / b) * (a / b) * (1 - c * c);
  if (cos2t <= 0) return {1, 1, 1, 0};
  const Real ct = sqrt(cos2t);
  const Real s = (a * c - b * ct) / (a * c + b * ct);
  const Real p = (b * c - a * ct) / (b * c + a * ct);
  return {s * s, p * p, (s * s + p * p) / 2, b / a * ct};
}

/// The rounding error of fresnelExact, derived: with n = n2 / n1
///  * g^2 is a sum of two terms of at most m = c^2 (or n^2 where c^2 > 1/2 > n^2 - 1), each with at
///    most 5 roundings (e has 4): |dg^2| <= 10 u m + u g^2, so |dg| <= D = d / max(g, sqrt(d));
///  * amplitudes |a| <= 1 with denominators c + g and n^2 c + g squared: |d a| <= 2 D /
///  denominator;
///    R is half the sum of their squares, so each contributes |a| |da| <= 2 D / denominator;
///  * q is a difference of terms of at most 1 + n^2 c^2, or n^2 + n^2 c^2: 6 u of those, times
///    |e| / (n^2 c + g)^2;
///  * what is left are at most 16 roundings of values of at most 1.
double bound(double c, double n1, double n2, double g) {
  const double n = n2 / n1;
  const double e = std::abs((n2 - n1) / n1 * (1.0 + n));
  const bool steep = n < 1.0 && c * c > 0.5;
  const double d = 10.0 * u * (steep ? n * n : std::max(c * c, g * g));
  const double D = d / std::max(g, std::sqrt(d));
  const double p = n * n * c + g;
  const double q = 6.0 * u * (steep ? n * n * (1.0 + c * c) : 1.0 + n * n * c * c);
  return 2.0 * D * (1.0 / (c + g) + 1.0 / p) + q * e / (p * p) + 16.0 * u;
}

void expectTrue(double c, double n1, double n2) {
  const Truth t = truth(c, n1, n2);
  const double got = fresnelExact(c, n1, n2);
  const double error = std::abs(double(Real(got) - t.r));
  ASSERT_LE(error, bound(c, n1, n2, double(t.g)))
      << std::hexfloat << "c " << c << " n1 " << n1 << " n2 " << n2;
  ASSERT_TRUE(got >= 0.0 && got <= 1.0);
  const double distance = std::abs(c - glint::criticalCosine(n1, n2));
  if (n1 <= n2 || distance > 1e-4) {
    ASSERT_LE(error, 1e-12) << std::hexfloat << "c " << c << " n1 " << n1 << " n2 " << n2;
  }
  const auto polarized = glint::fresnelPolarized(c, n1, n2);
  ASSERT_LE(std::abs(double(Real(polarized.perpendicular) - t.perpendicular)),
            2.0 * bound(c, n1, n2, double(t.g)));
  ASSERT_LE(std::abs(double(Real(polarized.parallel) - t.parallel)),
            2.0 * bound(c, n1, n2, double(t.g)));
}

// docs/science.md 4.1, 40 digits rounded to 8: half a unit of the last printed digit.
TEST(Fresnel, ReproducesTheTableOfReferenceValues) {
  const double pairs[10][2] = {{1, 1.0003}, {1, 1.1}, {1, 1.33}, {1, 1.5},  {1, 1.8},
                               {1, 2.4},    {1, 4},   {1.5, 1},  {1.33, 1}, {2.4, 1}};
  const struct {
    double degrees, r[10];
  } rows[] = {{0,
               {2.2493252e-8, 0.0022675737, 0.020059312, 0.04, 0.081632653, 0.16955017, 0.36, 0.04,
                0.020059312, 0.16955017}},
              {10,
               {2.2514981e-8, 0.0022693673, 0.020069685, 0.040015485, 0.081652256, 0.16956659,
                0.35999736, 0.040082959, 0.020093011, 0.17020444}},
              {20,
               {2.2887728e-8, 0.0022995745, 0.020239715, 0.040266229, 0.081965431, 0.16982542,
                0.35995637, 0.041728518, 0.020723326, 0.19492282}},
              {30,
               {2.4990503e-8, 0.0024634398, 0.021112458, 0.041522626, 0.083494712, 0.17106033,
                0.35976998, 0.055190167, 0.025089866, 1.0}},
              {40,
               {3.3632668e-8, 0.0030903153, 0.024151962, 0.045733643, 0.08842437, 0.17491861,
                0.35925721, 0.2452912, 0.054247415, 1.0}},
              {45,
               {4.4959537e-8, 0.0038521357, 0.027521384, 0.050239911, 0.093523121, 0.178817,
                0.35882865, 1.0, 0.13418672, 1.0}},
              {50,
               {6.7800507e-8, 0.0052683103, 0.033249863, 0.057662945, 0.1016856, 0.18496005,
                0.35831376, 1.0, 1.0, 1.0}},
              {60,
               {2.2444766e-7, 0.013069967, 0.059125599, 0.089186713, 0.1346433, 0.20935126,
                0.35791197, 1.0, 1.0, 1.0}},
              {70,
               {1.2976554e-6, 0.044461267, 0.1326566, 0.17104254, 0.21505848, 0.26938663, 0.3656893,
                1.0, 1.0, 1.0}},
              {75,
               {4.3472875e-6, 0.09026091, 0.2114266, 0.25306056, 0.29284749, 0.32977393, 0.38331801,
                1.0, 1.0, 1.0}},
              {80,
               {2.283638e-5, 0.19356276, 0.3469161, 0.38770435, 0.41874959, 0.43323603, 0.43155676,
                1.0, 1.0, 1.0}},
              {85,
               {0.00035558418, 0.43393196, 0.58272824, 0.61279965, 0.62939686, 0.62219691,
                0.56770703, 1.0, 1.0, 1.0}},
              {88,
               {0.0099329034, 0.71466689, 0.80362313, 0.81873457, 0.82488729, 0.81453284,
                0.76204478, 1.0, 1.0, 1.0}},
              {89,
               {0.070484991, 0.84519804, 0.89604651, 0.90418495, 0.90705789, 0.90004452, 0.86561395,
                1.0, 1.0, 1.0}}};
  for (const auto& row : rows) {
    for (int i = 0; i < 10; ++i) {
      const double digit = std::pow(10.0, std::floor(std::log10(row.r[i])) - 7.0);
      const double c = std::cos(row.degrees * degree);
      EXPECT_NEAR(fresnelExact(c, pairs[i][0], pairs[i][1]), row.r[i], 0.501 * digit)
          << row.degrees << " degrees, " << pairs[i][0] << " to " << pairs[i][1];
    }
  }
}

TEST(Fresnel, AgreesWithAHundredDigitsAtRandom) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int i = 0; i < 3000; ++i) {
    const double ratio = std::exp2(20.0 * unit(random) - 10.0);
    const double n1 = 1.0 + unit(random);
    // cosines concentrated towards grazing and normal incidence as well as uniform ones
    const double t = unit(random);
    const double c = i % 3 == 0   ? t
                     : i % 3 == 1 ? std::exp2(-40.0 * t)
                                  : 1.0 - std::exp2(-50.0 * t);
    expectTrue(c, n1, n1 * ratio);
    if (HasFatalFailure()) return;
  }
}

// K3, K4: indices that differ by a relative 1e-15 to 1e-3, both ways, at cosines around sqrt(2d),
// where the reflectance rises and, from the denser side, the critical angle is.
TEST(Fresnel, AgreesWithAHundredDigitsAsTheIndicesMeet) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int i = 0; i < 2000; ++i) {
    const double n1 = 1.0 + unit(random);
    const double n2 = n1 * (1.0 + std::exp2(-10.0 - 40.0 * unit(random)));
    if (n1 == n2) continue;
    const double d = (n2 - n1) / n1;
    const double c = std::min(std::sqrt(2.0 * d) * std::exp2(12.0 * unit(random) - 4.0), 1.0);
    expectTrue(c, n1, n2);
    expectTrue(c, n2, n1);
    if (HasFatalFailure()) return;
  }
}

// K9, K10: the critical cosine itself, and one ulp, two, four... to either side.
TEST(Fresnel, AgreesWithAHundredDigitsAroundTheCriticalAngle) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int i = 0; i < 40; ++i) {
    const double n2 = 1.0;
    const double n1 = i < 5 ? std::vector{1.5, 1.33, 2.4, 4.0, 1.0 + 1.2e-7}[std::size_t(i)]
                            : 1.0 + std::exp2(10.0 * unit(random) - 8.0);
    const double critical = glint::criticalCosine(n1, n2);
    for (double step = u; step < 0.1; step *= 2.0) {
      for (const double c : {critical, critical - step, critical + step}) {
        if (c < 0.0 || c > 1.0) continue;
        expectTrue(c, n1, n2);
        if (HasFatalFailure()) return;
      }
    }
  }
}

TEST(Fresnel, NamedCases) {
  for (const double c : {0.0, 1e-300, 0.3, 1.0, 2.0, -1.0, nan}) {  // K1, K2
    EXPECT_EQ(fresnelExact(c, 1.5, 1.5), 0.0);
    EXPECT_EQ(glint::fresnelTextbook(c, 1.5, 1.5), 0.0);
    EXPECT_EQ(glint::schlick(c, 1.5, 1.5), 0.0);
    EXPECT_EQ(glint::schlickExp2(c, 1.5, 1.5), 0.0);
  }
  for (const double n2 : {1e-3, 0.5, 1.0 + 1e-15, 1.5, 1e3}) {
    EXPECT_EQ(fresnelExact(0.0, 1.0, n2), 1.0) << n2;   // K5
    EXPECT_EQ(fresnelExact(-0.2, 1.0, n2), 1.0) << n2;  // K8: clamped
    EXPECT_EQ(glint::schlick(0.0, 1.0, n2), 1.0) << n2;
    const double r0 = std::pow((1.0 - n2) / (1.0 + n2), 2.0);
    EXPECT_NEAR(fresnelExact(1.0, 1.0, n2), r0, 16 * u) << n2;                   // K6
    EXPECT_EQ(fresnelExact(1.0 + 1.2e-7, 1.0, n2), fresnelExact(1.0, 1.0, n2));  // K7
    EXPECT_NEAR(glint::schlick(1.0, 1.0, n2), r0, 16 * u);
    EXPECT_NEAR(glint::fresnelConstants(1.0, n2).r0, r0, 16 * u);
  }
  // K3 and K4, where the textbook's form is off by 0.02 and 0.94 in single precision
  const double n = 1.0 + 0x1p-23;
  EXPECT_NEAR(fresnelExact(1.6e-4, 1.0, n), double(truth(1.6e-4, 1.0, n).r), 1e-13);
  EXPECT_NEAR(fresnelExact(5.07e-4, n, 1.0), double(truth(5.07e-4, n, 1.0).r), 1e-10);
  // K11: past the critical angle
  EXPECT_EQ(fresnelExact(std::cos(42 * degree), 1.5, 1.0), 1.0);
  EXPECT_EQ(glint::fresnelTextbook(std::cos(42 * degree), 1.5, 1.0), 1.0);
  EXPECT_EQ(glint::schlick(std::cos(42 * degree), 1.5, 1.0), 1.0);
}

// K13, K14 and any other number that a caller may pass.
TEST(Fresnel, IsTotal) {
  const double odd[] = {0.0, -0.0, -1.0, 1e-320, 1e-9, 1e-4,     1.0,      1.5,
                        1e4, 1e9,  1e30, 1e308,  nan,  infinity, -infinity};
  for (const double c : odd) {
    for (const double n1 : odd) {
      for (const double n2 : odd) {
        const auto k = glint::fresnelConstants(n1, n2);
        const double fit = glint::rationalSlope(n1, n2);
        for (const double r :
             {fresnelExact(c, n1, n2), glint::fresnelTextbook(c, n1, n2), glint::schlick(c, n1, n2),
              glint::schlick(c, n1, n2, c), glint::schlickExp2(c, n1, n2),
              glint::schlickRational(c, k, fit), k.r0, glint::criticalCosine(n1, n2)}) {
          EXPECT_TRUE(r >= 0.0 && r <= 1.0) << r << ' ' << c << ' ' << n1 << ' ' << n2;
        }
        EXPECT_TRUE(std::isfinite(glint::brewsterAngle(n1, n2)));
        EXPECT_TRUE(std::isfinite(fit) && fit >= 0.0) << n1 << ' ' << n2;
      }
    }
  }
}

TEST(Fresnel, PublishedNumbers) {  // docs/science.md 8.3, to their printed digits
  const struct {
    double n, r0, r0Digit, brewster, critical;
  } media[] = {{1.5, 0.04, 1e-15, 56.3099, 41.8103},
               {1.33, 0.0200593, 5e-8, 53.0612, 48.7535},
               {2.4, 0.1695502, 5e-8, 67.3801, 24.6243}};
  for (const auto& m : media) {
    EXPECT_NEAR(fresnelExact(1.0, 1.0, m.n), m.r0, m.r0Digit);
    EXPECT_NEAR(glint::brewsterAngle(1.0, m.n) / degree, m.brewster, 5e-5);
    EXPECT_NEAR(std::acos(glint::criticalCosine(m.n, 1.0)) / degree, m.critical, 5e-5);
  }
  EXPECT_NEAR(fresnelExact(std::cos(45 * degree), 1.0, 1.5), 0.0502399, 5e-8);
  EXPECT_NEAR(fresnelExact(std::cos(75 * degree), 1.0, 1.61), 0.27098, 5e-6);
  const auto p = glint::fresnelPolarized(std::cos(75 * degree), 1.0, 1.61);
  EXPECT_NEAR(std::sqrt(p.perpendicular), 0.66537, 5e-6);
  EXPECT_NEAR(std::sqrt(p.parallel), 0.31505, 5e-6);
  EXPECT_EQ(glint::criticalCosine(1.0, 1.5), 0.0);
}

TEST(Fresnel, BrewsterAndTheSquareAtFortyFiveDegrees) {  // K12
  for (const double n2 : {0.4, 1.0003, 1.5, 2.4, 100.0}) {
    const double c = std::cos(glint::brewsterAngle(1.0, n2));
    // c is off by u: R_par is the square of an amplitude that is off by a few u times its slope
    EXPECT_LT(glint::fresnelPolarized(c, 1.0, n2).parallel, 1e-24) << n2;
  }
  EXPECT_NEAR(fresnelExact(std::cos(glint::brewsterAngle(1.0, 1.5)), 1.0, 1.5), 0.0739645, 5e-8);
  for (const double n2 : {1.1, 1.5, 4.0}) {
    const auto r = glint::fresnelPolarized(std::sqrt(0.5), 1.0, n2);
    EXPECT_NEAR(r.parallel, r.perpendicular * r.perpendicular, 32 * u);
  }
}

// K17, and R from the refracted side; the cosine there has the relative error 2 u / g.
TEST(Fresnel, IsReciprocal) {
  for (const double n : {1.0003, 1.1, 1.33, 1.5, 2.4, 4.0}) {
    for (double c = 0.01; c <= 1.0; c += 0.01) {
      const double ct = std::sqrt(1.0 - (1.0 - c) * (1.0 + c) / (n * n));
      const auto inside = glint::fresnelConstants(n, 1.0);
      const double tolerance = 1e-12;  // c >= 0.01: 1e4 u from the slope towards grazing
      EXPECT_NEAR(fresnelExact(c, 1.0, n), fresnelExact(ct, inside), tolerance) << c << ' ' << n;
      EXPECT_NEAR(glint::schlick(c, 1.0, n), glint::schlick(ct, inside), 1e-10) << c << ' ' << n;
      EXPECT_NEAR(glint::schlickExp2(c, 1.0, n), glint::schlickExp2(ct, inside), 1e-10);
      EXPECT_NEAR(glint::schlickRational(c, glint::fresnelConstants(1.0, n), 3.0),
                  glint::schlickRational(ct, inside, 3.0), 1e-9);
    }
  }
}

// docs/science.md 4.6, by Simpson's rule in t with c = t^2 (R has a slope, not a kink, at grazing).
TEST(Fresnel, HemisphericalAverages) {
  const auto average = [](double n1, double n2) {
    const int steps = 20000;
    double sum = 0.0;
    for (int i = 0; i <= steps; ++i) {
      const double c = std::pow(double(i) / steps, 2.0);
      const double weight = (i == 0 || i == steps) ? 1.0 : i % 2 ? 4.0 : 2.0;
      sum += weight * fresnelExact(c, n1, n2) * 2.0 * c * 2.0 * std::sqrt(c);
    }
    return sum / (3.0 * steps);
  };
  const double expected[4][3] = {{1.33, 0.06593, 0.47195},
                                 {1.5, 0.09178, 0.59635},
                                 {1.8, 0.13405, 0.73273},
                                 {2.4, 0.21018, 0.86288}};
  for (const auto& row : expected) {
    const double outside = average(1.0, row[0]);
    const double inside = average(row[0], 1.0);
    EXPECT_NEAR(outside, row[1], 5.1e-6);
    EXPECT_NEAR(inside, row[2], 1.2e-5);  // the kink at the critical angle costs Simpson 5e-6
    EXPECT_NEAR(1.0 - outside, row[0] * row[0] * (1.0 - inside), 1e-4);
  }
}

TEST(Fresnel, TextbookAgreesAwayFromItsWeakPlaces) {
  for (const double n2 : {0.5, 0.75, 1.1, 1.5, 4.0}) {
    for (double c = 0.0; c <= 1.0; c += 1.0 / 64.0) {
      if (std::abs(c - glint::criticalCosine(1.0, n2)) < 1e-3) continue;
      EXPECT_NEAR(glint::fresnelTextbook(c, 1.0, n2), fresnelExact(c, 1.0, n2), 1e-12);
    }
  }
  // E1: the sum without the half is 0.08 at normal incidence and 2 at grazing.
  EXPECT_NEAR(glint::fresnelTextbook(1.0, 1.0, 1.5), 0.04, 4 * u);
}

TEST(Fresnel, MetalIsItsColourHeadOnAndWhiteAtGrazing) {
  const dvec3 gold(1.0, 0.71, 0.29);
  EXPECT_EQ(glint::metalReflectance(1.0, gold), gold);
  EXPECT_NEAR(glm::length(glint::metalReflectance(0.0, gold) - dvec3(1.0)), 0.0, 4 * u);
  EXPECT_NEAR(glint::metalReflectance(0.5, gold).z, 0.29 + 0.71 / 32.0, 4 * u);
}

TEST(Refraction, FollowsSnellInUnitLength) {
  std::mt19937_64 random(4);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  int total = 0;
  for (int i = 0; i < 20000; ++i) {
    const dvec3 N = glm::normalize(dvec3(normal(random), normal(random), normal(random)));
    dvec3 I = glm::normalize(dvec3(normal(random), normal(random), normal(random)));
    if (glm::dot(I, N) > 0.0) I = -I;
    const double n1 = 1.0 + 2.0 * unit(random), n2 = 1.0 + 2.0 * unit(random);
    const auto t = glint::refract(I, N, n1, n2);
    const double r = fresnelExact(-glm::dot(I, N), n1, n2);
    ASSERT_EQ(t.has_value(), r < 1.0);  // the flag agrees with the reflectance
    const dvec3 m = glint::reflect(I, N);
    ASSERT_NEAR(glm::length(m), 1.0, 16 * u);
    ASSERT_NEAR(glm::dot(m, N), -glm::dot(I, N), 16 * u);
    ASSERT_NEAR(glm::length(m - I + 2.0 * glm::dot(I, N) * N), 0.0, 16 * u);
    if (!t) {
      ++total;
      continue;
    }
    ASSERT_NEAR(glm::length(*t), 1.0, 16 * u);
    ASSERT_LE(glm::dot(*t, N), 0.0);
    const dvec3 snell = n1 * glm::cross(N, I) - n2 * glm::cross(N, *t);
    ASSERT_NEAR(glm::length(snell), 0.0, 64 * u);
  }
  EXPECT_GT(total, 1000);
  const dvec3 I = glm::normalize(dvec3(1.0, -1.0, 0.5));
  EXPECT_EQ(glint::refract(I, dvec3(0, 1, 0), 1.5, 1.5), I);  // K1
}

}  // namespace glint::fresnel_test
