#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "glint/shading/fresnel.h"

namespace fresnel_approximations_test {

constexpr double degree = std::numbers::pi / 180.0;

struct Errors {
  double max = 0.0, at = 0.0, mean = 0.0, rms = 0.0, weighted = 0.0;
};

/// |approximation - exact| over [from, to] degrees, by the midpoint rule. With 40000 angles the
/// maximum is missed by less than 1e-7, for a curvature of at most 1e3 per radian squared.
Errors errorsOf(const std::function<double(double)>& form, double n1, double n2, double from = 0.0,
                double to = 90.0) {
  const int count = 40000;
  Errors e;
  double weight = 0.0;
  for (int i = 0; i < count; ++i) {
    const double theta = from + (to - from) * (i + 0.5) / count;
    const double c = std::cos(theta * degree);
    const double error = std::abs(form(c) - glint::fresnelExact(c, n1, n2));
    if (error > e.max) {
      e.max = error;
      e.at = theta;
    }
    e.mean += error / count;
    e.rms += error * error / count;
    const double w = c * std::sin(theta * degree);
    e.weighted += w * error;
    weight += w;
  }
  e.rms = std::sqrt(e.rms);
  e.weighted /= weight;
  return e;
}

// The tables of docs/science.md. Three last digits, where the value is next to a tie, come from a
// finer sampling: 0.22855, 0.021048 and 0.037645.
constexpr double half = 0.5001;  // of a unit of the last printed digit

TEST(FresnelApproximations, SchlickErrsAsTabulated) {  // docs/science.md 4.4, from the thinner side
  const double table[][6] = {
      {1.0003, 0.8553, 88.7, 0.1041, 0.2285, 0.0475}, {1.1, 0.2105, 83.1, 0.0399, 0.0769, 0.0247},
      {1.33, 0.0599, 83.8, 0.0109, 0.0201, 0.0073},   {1.5, 0.0357, 85.0, 0.0092, 0.0135, 0.0087},
      {1.8, 0.0345, 85.4, 0.0106, 0.0149, 0.0107},    {2.4, 0.0740, 84.5, 0.0132, 0.0239, 0.0093},
      {4, 0.2009, 84.0, 0.0383, 0.0725, 0.0238}};
  for (const auto& row : table) {
    const double n = row[0];
    const Errors e = errorsOf([n](double c) { return glint::schlick(c, 1.0, n); }, 1.0, n);
    EXPECT_NEAR(e.max, row[1], half * 1e-4) << n;
    EXPECT_NEAR(e.at, row[2], half * 1e-1) << n;
    EXPECT_NEAR(e.mean, row[3], half * 1e-4) << n;
    EXPECT_NEAR(e.rms, row[4], half * 1e-4) << n;
    EXPECT_NEAR(e.weighted, row[5], half * 1e-4) << n;
  }
}

TEST(FresnelApproximations, SchlickFromTheDenserSideNeedsTheRefractedAngle) {
  // n, critical angle, maximum, where, mean in [0, critical)
  const double table[][5] = {
      {1.0003, 88.597, 0.8553, 88.1, 0.0958}, {1.1, 65.380, 0.2105, 64.5, 0.0210},
      {1.33, 48.753, 0.0599, 48.4, 0.0051},   {1.5, 41.810, 0.0357, 41.6, 0.0059},
      {1.8, 33.749, 0.0345, 33.6, 0.0070},    {2.4, 24.624, 0.0740, 24.5, 0.0057},
      {4, 14.478, 0.2009, 14.4, 0.0130}};
  for (const auto& row : table) {
    const double n = row[0];
    const double critical = std::acos(glint::criticalCosine(n, 1.0)) / degree;
    EXPECT_NEAR(critical, row[1], half * 1e-3);
    const Errors e =
        errorsOf([n](double c) { return glint::schlick(c, n, 1.0); }, n, 1.0, 0.0, critical);
    EXPECT_NEAR(e.max, row[2], half * 1e-4) << n;
    EXPECT_NEAR(e.at, row[3], half * 1e-1) << n;
    EXPECT_NEAR(e.mean, row[4], half * 1e-4) << n;
    // E2, K15: with cos(theta_i), R stays near R0 close to the critical angle, where it is 1.
    const Errors wrong =
        errorsOf([n](double c) { return glint::schlick(c, 1.0, n); }, n, 1.0, 0.0, critical);
    EXPECT_GT(wrong.max, 0.55) << n;
  }
  EXPECT_NEAR(glint::schlick(std::cos(40.0 * degree), 1.5, 1.0), 0.2456, half * 1e-4);
  EXPECT_NEAR(glint::schlick(std::cos(41.8 * degree), 1.5, 1.0), 0.9075, half * 1e-4);
}

TEST(FresnelApproximations, TheOthersErrAsTabulated) {  // docs/science.md 4.5
  // n, exp2, rational with minimax k, that k, rational with the slope's k, that k
  const double table[][6] = {
      {1.1, 0.2121, 0.0248, 4.655, 0.0547, 3.834}, {1.33, 0.0622, 0.0119, 2.479, 0.0257, 2.222},
      {1.5, 0.0387, 0.0069, 2.163, 0.0141, 2.028}, {1.8, 0.0376, 0.0015, 2.106, 0.0022, 2.085},
      {2.4, 0.0764, 0.0022, 2.681, 0.0038, 2.731}, {4, 0.2024, 0.0201, 7.137, 0.0359, 5.858}};
  for (const auto& row : table) {
    const double n = row[0];
    const auto constants = glint::fresnelConstants(1.0, n);
    const double minimax = glint::rationalMinimax(1.0, n);
    const double slope = glint::rationalSlope(1.0, n);
    EXPECT_NEAR(errorsOf([n](double c) { return glint::schlickExp2(c, 1.0, n); }, 1.0, n).max,
                row[1], half * 1e-4);
    const auto rational = [&](double k) {
      return errorsOf([&](double c) { return glint::schlickRational(c, constants, k); }, 1.0, n)
          .max;
    };
    EXPECT_NEAR(rational(minimax), row[2], half * 1e-4) << n;
    EXPECT_NEAR(minimax, row[3], 2e-3) << n;  // accuracy of the search that made the table
    EXPECT_NEAR(rational(slope), row[4], half * 1e-4) << n;
    EXPECT_NEAR(slope, row[5], half * 1e-3) << n;
    // Optimal: no other k is better, up to the error of 512 angles in the maximum.
    EXPECT_LT(rational(minimax), rational(minimax * 1.01));
    EXPECT_LT(rational(minimax), rational(minimax * 0.99));
    EXPECT_EQ(glint::rationalMinimax(n, 1.0), minimax);
  }
}

TEST(FresnelApproximations, RationalIsTheBestOfItsFamilyBeyondTheTable) {
  for (const double n : {1.0003, 1.01, 6.0, 10.0}) {
    const auto constants = glint::fresnelConstants(1.0, n);
    const auto error = [&](double k) {
      return errorsOf([&](double c) { return glint::schlickRational(c, constants, k); }, 1.0, n)
          .max;
    };
    const double k = glint::rationalMinimax(1.0, n);
    EXPECT_LT(error(k), error(1.02 * k)) << n;
    EXPECT_LT(error(k), error(0.98 * k)) << n;
  }
}

TEST(FresnelApproximations, TheMinimaxExponentsErrAsTabulated) {
  const double table[][3] = {{1.1, 8.83, 0.0182}, {1.33, 5.66, 0.0228}, {1.5, 5.20, 0.0253},
                             {1.8, 5.11, 0.0290}, {2.4, 5.95, 0.0323},  {4, 12.35, 0.0109}};
  for (const auto& row : table) {
    const auto form = [&](double c) { return glint::schlick(c, 1.0, row[0], row[1]); };
    // the exponent is printed to half of 0.01, which moves the maximum by up to 2e-4
    EXPECT_NEAR(errorsOf(form, 1.0, row[0]).max, row[2], 2e-4) << row[0];
  }
}

TEST(FresnelApproximations, RationalIsExactAtBothEndsAndInSlope) {
  for (const double n : {1.01, 1.5, 4.0, 50.0}) {
    const auto constants = glint::fresnelConstants(1.0, n);
    const double k = glint::rationalSlope(1.0, n);
    EXPECT_EQ(glint::schlickRational(0.0, constants, k), 1.0);
    EXPECT_NEAR(glint::schlickRational(1.0, constants, k), constants.r0, 1e-15);
    const double h = 1e-6 / (1.0 + k);
    const double exact = (1.0 - glint::fresnelExact(h, constants)) / h;
    const double rational = (1.0 - glint::schlickRational(h, constants, k)) / h;
    EXPECT_NEAR(rational / exact, 1.0, 1e-5)
        << n;  // the second order is about 1e-6, rounding 1e-10
  }
}

}  // namespace fresnel_approximations_test
