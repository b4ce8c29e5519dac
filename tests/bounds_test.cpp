// The bounds of the forms, tested from both sides: no error found is above its bound, and no bound
// is more than 1.5 times the worst error found.

#include "glint/shading/bounds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <vector>

namespace glint::bounds_test {

int draws(int usual) {
  const char* more = std::getenv("GLINT_BOUND_DRAWS");
  return more != nullptr ? std::max(std::atoi(more), 1) : usual;
}

// Searches for the worst error of a lobe's form: at its cut-off, at 90 degrees and just beyond,
// over two scales of lambda, and then ever closer around the worst of these.
double worstOfLobe(Highlight form, int gamma, double alpha) {
  double worst = 0, at = 0;
  const auto attempt = [&](double x) {
    if (!(x >= 0 && x <= 2)) return;
    const double exact = x < 1 ? std::exp(alpha * std::log1p(-x)) : 0.0;
    const double error = std::abs(lobe(form, gamma, x, alpha) - exact);
    if (error > worst) worst = error, at = x;
  };
  const int count = 600;
  const double scale = std::min(12 / alpha, 2.0);
  for (int i = 0; i <= count; ++i) {
    attempt(2.0 * i / count);
    attempt(scale * i / count);
  }
  if (row(form).hasTable)  // at midpoints of the first and the last steps
    for (int step = 0; step < 3; ++step)
      for (int i = 1; i < 64; ++i) {
        attempt(1 - (step + i / 64.0) / gamma);
        attempt((step + i / 64.0) / gamma);
      }
  for (double end : {1.0, gamma / alpha, 2 * gamma / (gamma + alpha), 1 / tunedSlope(alpha, gamma)})
    for (double off : {0.0, 1e-15, 1e-9}) attempt(end * (1 - off)), attempt(end * (1 + off));
  const double around = row(form).hasTable ? 1.0 / gamma : scale / count;
  for (double step = around; step > 1e-9 * around; step *= 0.5) {
    const double middle = at;
    for (int i = -2; i <= 2; ++i) attempt(middle + step * i);
  }
  return worst;
}

// The forms that approximate the exact lobe.
std::vector<Highlight> approximations() {
  std::vector<Highlight> forms;
  for (const HighlightRow& each : highlightRows())
    if (each.formulaBound && each.form != Highlight::none) forms.push_back(each.form);
  return forms;
}

TEST(Bounds, OfLobesAreTheWorstThereIs) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(0, 1);
  const std::vector<Highlight> forms = approximations();
  double loosest = 0;
  for (int i = 0; i < draws(4000); ++i) {
    const Highlight form = forms[std::size_t(i) % forms.size()];
    const int gamma = std::max(row(form).leastGamma, 1) << int(7 * unit(random));
    // From 0.2 on: below that, doubles next to lambda = 1 cannot resolve the lobe's steep fall.
    double alpha = 0.2 * std::pow(5e6, unit(random));
    if (i % 7 == 0) alpha = gamma * (1 + 0.02 * (unit(random) - 0.5));
    const double bound = lobeFormulaBound(form, gamma, alpha);
    const double worst = worstOfLobe(form, gamma, alpha);
    ASSERT_LE(worst, bound + 1e-9 * bound + 1e-12)
        << int(form) << ":" << gamma << " alpha " << alpha;
    ASSERT_LE(bound, 1.5 * worst + 1e-9) << int(form) << ":" << gamma << " alpha " << alpha;
    if (worst > 1e-8) loosest = std::max(loosest, bound / worst);
  }
  RecordProperty("loosest", std::to_string(loosest));
}

TEST(Bounds, OfLobesAtTheEndsOfTheRange) {
  for (Highlight form : approximations())
    for (int k = 0; k < 7; ++k) {
      const int gamma = std::max(row(form).leastGamma, 1) << k;
      EXPECT_EQ(lobeFormulaBound(form, gamma, 0), 0.0);
      for (double alpha : {1e-6, 1e-3, 1.0, 2.0, 1e6}) {
        const double bound = lobeFormulaBound(form, gamma, alpha);
        EXPECT_TRUE(bound >= 0 && bound <= 1) << int(form) << ":" << gamma << " " << alpha;
        EXPECT_LE(worstOfLobe(form, gamma, alpha), bound + 1e-12);
      }
      if (form == Highlight::lyon || form == Highlight::pade) {  // exact there
        EXPECT_LE(lobeFormulaBound(form, gamma, gamma), 1e-12);
      }
    }
  for (Highlight form : {Highlight::exact, Highlight::pow, Highlight::integer})
    EXPECT_EQ(lobeFormulaBound(form, 1, 20), 0.0);
  // Published: 0.0350 (gamma 8, alpha 1000), 0.0164 tuned, 0.134 / alpha.
  EXPECT_NEAR(lobeFormulaBound(Highlight::lyon, 8, 1000), 0.0350, 6e-5);
  EXPECT_NEAR(lobeFormulaBound(Highlight::lyonTuned, 8, 1000), 0.0164, 6e-5);
  EXPECT_NEAR(lobeFormulaBound(Highlight::gaussian, 1, 1e4), 0.1337e-4, 1e-8);
}

// The chord of x^2 over a step h is off by h^2 / 4 at its middle, that of the root by h^(1/2) / 4
// in the first step; for larger exponents by at most a (a - 1) h^2 / 8, and hardly less if that is
// small.
TEST(Bounds, OfATableAreThoseOfItsChords) {
  for (const int steps : {16, 64, 1024}) {
    const double h = 1.0 / steps;
    EXPECT_NEAR(tableBound(2, steps), h * h / 4, 1e-15);
    EXPECT_NEAR(tableBound(0.5, steps), std::sqrt(h) / 4, 1e-15);
    EXPECT_EQ(tableBound(1, steps), 0);
    EXPECT_NEAR(tableBound(1 + 1e-9, steps), 0, 1e-9);
    EXPECT_NEAR(tableBound(2 - 1e-9, steps), tableBound(2, steps), 1e-9);
    for (const double alpha : {3.0, 5.0, 20.0, 1000.0, 1e6})
      EXPECT_LE(tableBound(alpha, steps), alpha * (alpha - 1) * h * h / 8) << alpha;
  }
  EXPECT_NEAR(tableBound(20, 1024) / (20 * 19 / 8.0 / (1024 * 1024)), 1, 0.02);
  EXPECT_GT(tableBound(1e6, 1024), 0.9);  // one step spans the whole lobe
}

TEST(Bounds, OfReflectancesAreNearTheWorstThereIs) {
  std::mt19937 random(12);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < draws(300); ++i) {
    const auto form = Fresnel(2 + i % 3);
    double n = 1 + 3 * unit(random);
    if (i % 3 == 1) n = 1 + std::pow(10, -7 + 6 * unit(random));
    if (i % 3 == 2) n = std::pow(10, 3 * unit(random));
    const double exponent = i % 2 ? 5 : 20 * unit(random);
    const FresnelConstants constants = fresnelConstants(1, n);
    const double k = rationalMinimax(1, n),
                 scale = std::sqrt(constants.e) / constants.nSquaredPlus1;
    double worst = 0;
    for (int j = 0; j < 3000; ++j) {
      const double t = (j + 0.5) / 3000;
      for (double c : {t, scale * t / (1 - t + scale * t)}) {
        const double value = form == Fresnel::schlick       ? schlick(c, constants, exponent)
                             : form == Fresnel::schlickExp2 ? schlickExp2(c, constants)
                                                            : schlickRational(c, constants, k);
        worst = std::max(worst, std::abs(value - fresnelExact(c, constants)));
      }
    }
    const double bound = fresnelFormulaBound(form, 1, n, exponent);
    ASSERT_LE(worst, bound + 1e-9) << int(form) << " n " << n << " exponent " << exponent;
    ASSERT_LE(bound, 1.5 * worst + 1e-8) << int(form) << " n " << n << " exponent " << exponent;
    // The same from the denser side, where the angles are compressed.
    EXPECT_NEAR(fresnelFormulaBound(form, n, 1, exponent), bound, 1e-6 * bound + 1e-12);
  }
  EXPECT_EQ(fresnelFormulaBound(Fresnel::schlick, 1.5, 1.5), 0.0);
  EXPECT_EQ(fresnelFormulaBound(Fresnel::exact, 1, 1.5), 0.0);
}

// The effect of rounding the cosine on the exact reflectance is largest at grazing incidence or
// next to the critical angle.
TEST(Bounds, OfRoundingCoverEveryCosine) {
  std::mt19937 random(13);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < draws(200); ++i) {
    const double n = i % 2 ? 1 + 3 * unit(random) : 1 + std::pow(10, -6 + 8 * unit(random));
    for (bool denser : {false, true}) {
      const double n1 = denser ? n : 1, n2 = denser ? 1 : n, steep = criticalCosine(n1, n2);
      const double bound = fresnelRoundingBound(Fresnel::exact, n1, n2);
      for (int j = 0; j < 300; ++j) {
        const double c = steep + criticalRing(n1, n2) +
                         (1 - steep) * (std::pow(10, -8 * unit(random)) - (denser ? 0 : 1e-8));
        if (c > 1) continue;
        const double u = 0x1p-24;
        for (double off : {5 * u * (1 + c), -5 * u * (1 + c)})
          ASSERT_LE(std::abs(fresnelExact(c + off, n1, n2) - fresnelExact(c, n1, n2)), bound)
              << n1 << " to " << n2 << " at " << c;
      }
    }
  }
  // Out of glass, the part that the ring leaves out would be ten times as large.
  EXPECT_EQ(criticalRing(1, 1.5), 0.0);
  EXPECT_EQ(criticalRing(1.5, 1), 1e-5);
  EXPECT_LT(fresnelRoundingBound(Fresnel::exact, 1.5, 1), 1e-3);
  EXPECT_GT(1 - fresnelExact(criticalCosine(1.5, 1) + 5e-7, 1.5, 1), 5e-3);
  EXPECT_LT(fresnelRoundingBound(Fresnel::exact, 1, 1.5), 5e-6);
}

TEST(Bounds, OfEnvironments) {
  for (auto map :
       {BuiltinEnvironment::studio, BuiltinEnvironment::sky, BuiltinEnvironment::white}) {
    double most = 0, steepest = 0;
    std::mt19937 random(14);
    std::normal_distribution<double> normal;
    const auto brightest = [&](const glm::dvec3& d) {
      const glm::dvec3 e = environmentRadiance(map, d);
      return std::max({e.x, e.y, e.z});
    };
    glm::dvec3 best(0, 1, 0), bestSlope(0, 1, 0);
    for (int i = 0; i < 100000; ++i) {
      // A third of them ever nearer to the brightest, a third to the steepest point.
      const glm::dvec3 any(normal(random), normal(random), normal(random));
      const glm::dvec3 middle = i % 3 == 0 ? glm::dvec3(0) : i % 3 == 1 ? best : bestSlope;
      const double around = i % 3 == 0 ? 1 : std::pow(0.5, i / 5000.0);
      const glm::dvec3 d = glm::normalize(middle + around * any);
      const double value = brightest(d);
      if (value > most) most = value, best = d;
      const glm::dvec3 near =
          glm::normalize(d + 1e-6 * glm::dvec3(normal(random), normal(random), normal(random)));
      const glm::dvec3 change = environmentRadiance(map, near) - environmentRadiance(map, d);
      const double way = glm::length(near - d);
      if (!(way > 1e-7)) continue;
      const double slope =
          std::max({std::abs(change.x), std::abs(change.y), std::abs(change.z)}) / way;
      if (slope > steepest) steepest = slope, bestSlope = d;
    }
    EXPECT_LE(most, largestRadiance(map));
    EXPECT_GE(1.1 * most, largestRadiance(map));
    EXPECT_LE(steepest, steepestRadiance(map));
    EXPECT_GE(1.1 * steepest, steepestRadiance(map));
  }
}

}  // namespace glint::bounds_test
