#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "glint/shading/forms.h"
#include "glint/shading/lobe.h"

namespace lobe_approximations_test {

using Form = std::function<double(double lambda)>;

struct Errors {
  double max = 0.0, at = 0.0, rms = 0.0, sphere = 0.0, relative = 0.0;
};

double errorAt(const Form& form, double alpha, double rho) {
  const double lambda = 2.0 * std::pow(std::sin(rho / 2.0), 2.0);
  const double exact = rho < std::numbers::pi / 2 ? std::pow(std::cos(rho), alpha) : 0.0;
  return std::abs(form(lambda) - exact);
}

/// Errors against cos^alpha over [0, 180] degrees by the midpoint rule with 40000 angles. The
/// maximum may be at the kink where the form is cut off, so it is refined between the neighbours of
/// the largest value, to 1e-7 radian, with slopes of at most sqrt(alpha).
Errors errorsOf(const Form& form, double alpha) {
  const int count = 40000;
  const double step = std::numbers::pi / count;
  Errors e;
  double lobe = 0.0;
  double best = 0.0;
  for (int i = 0; i < count; ++i) {
    const double rho = step * (i + 0.5);
    const double error = errorAt(form, alpha, rho);
    if (error > e.max) {
      e.max = error;
      best = rho;
    }
    const double exact = rho < std::numbers::pi / 2 ? std::pow(std::cos(rho), alpha) : 0.0;
    const double weight = std::sin(rho) / 2.0 * std::numbers::pi;
    e.rms += error * error / count;
    e.sphere += weight * error * error / count;
    lobe += weight * exact * exact / count;
  }
  for (int i = -1000; i <= 1000; ++i) {
    const double rho = best + step * i / 1000.0;
    const double error = errorAt(form, alpha, rho);
    if (error > e.max) {
      e.max = error;
      best = rho;
    }
  }
  e.at = best * 180.0 / std::numbers::pi;
  e.relative = std::sqrt(e.sphere / lobe);
  e.rms = std::sqrt(e.rms);
  e.sphere = std::sqrt(e.sphere);
  return e;
}

constexpr double half = 0.51;  // of a unit of the last printed digit
const double alphas[] = {1, 5, 10, 20, 50, 100, 200, 500, 1000, 10000};

// docs/science.md 2.2. For gamma = 1 the maximum is where the form is cut off, (1 - 1/alpha)^alpha,
// which gives two last digits more accurately than sampling: 0.36696 and 0.36786.
TEST(LobeApproximations, LyonErrsAsTabulated) {
  const double maximum[10][7] = {{0.0000, 0.2500, 0.3164, 0.3436, 0.3561, 0.3621, 0.3650},
                                 {0.3277, 0.1058, 0.0159, 0.0228, 0.0408, 0.0495, 0.0538},
                                 {0.3487, 0.1350, 0.0460, 0.0073, 0.0107, 0.0195, 0.0238},
                                 {0.3585, 0.1487, 0.0601, 0.0216, 0.0035, 0.0052, 0.0095},
                                 {0.3642, 0.1567, 0.0684, 0.0299, 0.0118, 0.0031, 0.0012},
                                 {0.3660, 0.1593, 0.0711, 0.0326, 0.0146, 0.0058, 0.0015},
                                 {0.3670, 0.1606, 0.0725, 0.0340, 0.0159, 0.0072, 0.0029},
                                 {0.3675, 0.1614, 0.0733, 0.0348, 0.0167, 0.0080, 0.0037},
                                 {0.3677, 0.1616, 0.0735, 0.0350, 0.0170, 0.0083, 0.0040},
                                 {0.3679, 0.1619, 0.0738, 0.0353, 0.0172, 0.0085, 0.0042}};
  const double relative[10][7] = {{0.0000, 0.2739, 0.4015, 0.4605, 0.4883, 0.5018, 0.5084},
                                  {0.3694, 0.1664, 0.0296, 0.0452, 0.0836, 0.1030, 0.1128},
                                  {0.4062, 0.2171, 0.0877, 0.0150, 0.0228, 0.0420, 0.0517},
                                  {0.4241, 0.2417, 0.1161, 0.0449, 0.0076, 0.0114, 0.0210},
                                  {0.4347, 0.2562, 0.1329, 0.0626, 0.0257, 0.0069, 0.0027},
                                  {0.4383, 0.2611, 0.1385, 0.0686, 0.0317, 0.0129, 0.0034},
                                  {0.4400, 0.2634, 0.1413, 0.0715, 0.0348, 0.0160, 0.0065},
                                  {0.4411, 0.2649, 0.1430, 0.0733, 0.0366, 0.0178, 0.0083},
                                  {0.4414, 0.2654, 0.1435, 0.0739, 0.0372, 0.0184, 0.0089},
                                  {0.4417, 0.2658, 0.1440, 0.0744, 0.0377, 0.0189, 0.0095}};
  for (int a = 0; a < 10; ++a) {
    for (int g = 0; g < 7; ++g) {
      const double alpha = alphas[a];
      const int gamma = 1 << g;
      const Errors e = errorsOf([&](double x) { return glint::lyon(x, alpha, gamma); }, alpha);
      EXPECT_NEAR(e.max, maximum[a][g], half * 1e-4) << alpha << ' ' << gamma;
      EXPECT_NEAR(e.relative, relative[a][g], half * 1e-4) << alpha << ' ' << gamma;
    }
  }
}

TEST(LobeApproximations, LyonErrsOverAngleAndSphereAsTabulated) {  // gamma = 8, three digits
  const struct {
    double alpha, rms, sphere, at;
  } rows[] = {{5, 8.86e-3, 9.64e-3, 50.10},
              {10, 2.43e-3, 2.32e-3, 35.46},
              {100, 6.15e-3, 3.42e-3, 11.21},
              {1000, 3.72e-3, 1.17e-3, 3.54}};
  for (const auto& row : rows) {
    const Errors e = errorsOf([&](double x) { return glint::lyon(x, row.alpha, 8); }, row.alpha);
    EXPECT_NEAR(e.rms, row.rms, half * 1e-5) << row.alpha;
    EXPECT_NEAR(e.sphere, row.sphere, half * 1e-5) << row.alpha;
    EXPECT_NEAR(e.at, row.at, half * 1e-2) << row.alpha;
  }
}

TEST(LobeApproximations, LyonCrossErrsAsTabulated) {  // docs/science.md 2.2, gated
  const double maximum[10][7] = {{0.5000, 0.5625, 0.5862, 0.5967, 0.6017, 0.6041, 0.6053},
                                 {0.2789, 0.0387, 0.0518, 0.0902, 0.1079, 0.1164, 0.1206},
                                 {0.3277, 0.1058, 0.0159, 0.0228, 0.0408, 0.0495, 0.0538},
                                 {0.3487, 0.1350, 0.0460, 0.0073, 0.0107, 0.0195, 0.0238},
                                 {0.3604, 0.1514, 0.0629, 0.0243, 0.0063, 0.0024, 0.0067},
                                 {0.3642, 0.1567, 0.0684, 0.0299, 0.0118, 0.0031, 0.0012},
                                 {0.3660, 0.1593, 0.0711, 0.0326, 0.0146, 0.0058, 0.0015},
                                 {0.3671, 0.1609, 0.0727, 0.0342, 0.0162, 0.0075, 0.0032},
                                 {0.3675, 0.1614, 0.0733, 0.0348, 0.0167, 0.0080, 0.0037},
                                 {0.3678, 0.1619, 0.0737, 0.0352, 0.0172, 0.0085, 0.0042}};
  for (int a = 0; a < 10; ++a) {
    for (int g = 0; g < 7; ++g) {
      const double alpha = alphas[a];
      const int gamma = 1 << g;
      const Errors e = errorsOf([&](double x) { return glint::lyonCross(x, alpha, gamma); }, alpha);
      EXPECT_NEAR(e.max, maximum[a][g], half * 1e-4) << alpha << ' ' << gamma;
    }
  }
}

TEST(LobeApproximations, TheOthersErrAsTabulated) {  // docs/science.md 2.3, 2.4
  using glint::Highlight;
  const struct {
    Highlight form;
    int gamma;
    double alpha, max, maxDigit;
  } rows[] = {{Highlight::lyonTuned, 4, 10, 0.0208, 1e-4},
              {Highlight::lyonTuned, 8, 10, 0.0034, 1e-4},
              {Highlight::lyonTuned, 4, 20, 0.0283, 1e-4},
              {Highlight::lyonTuned, 8, 20, 0.0098, 1e-4},
              {Highlight::lyonTuned, 16, 20, 0.0016, 1e-4},
              {Highlight::lyonTuned, 32, 20, 0.0025, 1e-4},
              {Highlight::lyonTuned, 4, 100, 0.0345, 1e-4},
              {Highlight::lyonTuned, 8, 100, 0.0152, 1e-4},
              {Highlight::lyonTuned, 16, 100, 0.0067, 1e-4},
              {Highlight::lyonTuned, 32, 100, 0.0027, 1e-4},
              {Highlight::lyonTuned, 4, 1000, 0.0359, 1e-4},
              {Highlight::lyonTuned, 8, 1000, 0.0164, 1e-4},
              {Highlight::lyonTuned, 16, 1000, 0.0079, 1e-4},
              {Highlight::lyonTuned, 32, 1000, 0.0039, 1e-4},
              {Highlight::pade, 4, 20, 0.0068, 1e-4},
              {Highlight::pade, 4, 100, 0.0071, 1e-4},
              {Highlight::pade, 4, 1000, 0.0071, 1e-4},
              {Highlight::pade, 8, 20, 0.0015, 1e-4},
              {Highlight::pade, 8, 100, 0.0017, 1e-4},
              {Highlight::pade, 8, 1000, 0.0018, 1e-4},
              {Highlight::pade, 16, 20, 0.00016, 1e-5},
              {Highlight::pade, 16, 100, 0.00043, 1e-5},
              {Highlight::pade, 16, 1000, 0.00044, 1e-5},
              {Highlight::gaussian, 1, 20, 0.0066, 1e-4},
              {Highlight::gaussian, 1, 100, 0.0013, 1e-4},
              {Highlight::gaussian, 1, 1000, 0.00013, 1e-5},
              {Highlight::exact, 1, 20, 0, 1e-14},
              {Highlight::pow, 1, 1000, 0, 1e-12}};
  for (const auto& row : rows) {
    const Errors e = errorsOf(
        [&](double x) { return glint::lobe(row.form, row.gamma, x, row.alpha); }, row.alpha);
    EXPECT_NEAR(e.max, row.max, half * row.maxDigit)
        << int(row.form) << ' ' << row.gamma << ' ' << row.alpha;
  }
}

TEST(LobeApproximations, LawsForLargeExponents) {
  const double alpha = 1e4;
  for (const int gamma : {16, 32, 64}) {
    const double lyon = errorsOf([&](double x) { return glint::lyon(x, alpha, gamma); }, alpha).max;
    EXPECT_NEAR(lyon / (0.271 * (1.0 / gamma - 1.0 / alpha)), 1.0, 0.03) << gamma;
    const double pade = errorsOf([&](double x) { return glint::pade(x, alpha, gamma); }, alpha).max;
    EXPECT_NEAR(pade * gamma * gamma, 0.112, 0.003) << gamma;
  }
  // With x = alpha lambda the error is exp(-x)(x^2/2 - 0.69 x) / alpha to first order, whose
  // extremes are -0.1337 at x = 0.475 and 0.1212 at 2.905.
  const double gaussian = errorsOf([&](double x) { return glint::gaussian(x, alpha); }, alpha).max;
  EXPECT_NEAR(gaussian * alpha, 0.1337, 1e-4);
}

// docs/science.md 1, the identities; equal up to rounding, gamma roundings for the squarings.
TEST(LobeApproximations, Identities) {
  for (double lambda = 0.0; lambda < 1.0; lambda += 1.0 / 128.0) {
    for (int gamma = 1; gamma <= 64; gamma *= 2) {
      const double exact = glint::lobeExact(lambda, gamma);
      const double tolerance = 0x1p-53 * 4.0 * gamma;
      EXPECT_NEAR(glint::lyon(lambda, gamma, gamma), exact, tolerance);  // D8
      EXPECT_NEAR(glint::lyonTuned(lambda, gamma, gamma), exact, tolerance);
      EXPECT_NEAR(glint::pade(lambda, gamma, gamma), exact, tolerance);
      EXPECT_NEAR(glint::lyonCross(lambda, 2.0 * gamma, gamma),
                  glint::lobeExact(lambda, 2.0 * gamma), 2.0 * tolerance);
    }
  }
  // E7, D7: alpha < gamma leaks
  EXPECT_NEAR(glint::lyon(1.0, 1.0, 8), 0.344, 5e-4);
  EXPECT_NEAR(glint::lyon(2.0, 1.0, 8), 0.100, 5e-4);
  // a gamma that is not a power of two counts as the next lower one, in beta too
  EXPECT_EQ(glint::lyon(0.1, 20.0, 15), glint::lyon(0.1, 20.0, 8));
  EXPECT_EQ(glint::lyon(0.1, 20.0, 200), glint::lyon(0.1, 20.0, 64));
}

}  // namespace lobe_approximations_test
