#include "glint/shading/lobe.h"
#include "glint/shading/forms.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/multiprecision/cpp_dec_float.hpp>
#include <cmath>
#include <limits>
#include <random>

#include "glint/shading/safe.h"

namespace lobe_test {

using glm::dvec3;

using Real = boost::multiprecision::cpp_dec_float_50;

constexpr double u = 0x1p-53;  // unit roundoff
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// 50-digit vectors, normalised with 50 digits.
struct Vector {
  Real x, y, z;
  explicit Vector(const glm::vec3& v) : x(v.x), y(v.y), z(v.z) { normalize(); }
  Vector(Real a, Real b, Real c) : x(a), y(b), z(c) {}
  void normalize() {
    const Real length = sqrt(x * x + y * y + z * z);
    x /= length, y /= length, z /= length;
  }
};

Real dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

Real phongCosine(const Vector& N, const Vector& L, const Vector& V) {
  return 2 * dot(N, L) * dot(N, V) - dot(L, V);
}

Real blinnCosine(const Vector& N, const Vector& L, const Vector& V) {
  Vector H(L.x + V.x, L.y + V.y, L.z + V.z);
  H.normalize();
  return dot(N, H);
}

Real lobeTruth(const Real& cosine, double alpha) {
  return cosine > 0 ? pow(cosine, Real(alpha)) : Real(0);
}

/// The supremum over d of the slope of the lobe, alpha d (1 - d^2/2)^(alpha - 1), d = |D|: at
/// d^2 = 1 / (alpha - 1/2). Below 1.42 sqrt(alpha) for alpha >= 1, near 0.61 sqrt(alpha) for large
/// alpha.
double steepest(double alpha) {
  return alpha / std::sqrt(alpha - 0.5) * std::pow(1.0 - 1.0 / (2.0 * alpha - 1.0), alpha - 1.0);
}

// The bounds. A double unit vector is off by at most 2.5 u in direction and length. Lengths affect
// lambda only in second order (|R|, |V| near each other) or as a relative error, so what counts is
// |dD|.
//
// Phong, D = (L + V) - 2 (N.L) N: L and V 2.5 u each, N 4 * 2.5 u, the dot product 2 * 2 u, its
// product with N 2 u, the sum L + V 2 u, the last difference at most u |D|: below 24 u.
// Blinn, D = N - H: N 2.5 u, H's normalisation 2.5 u, difference u; L + V is off by 2.5 + 2.5 + 2
// u, which dividing by |L + V| magnifies: 6 u + 7 u / |L + V|.
//
// The lobe is then off by steepest(alpha) |dD|, and by at most 2 u from log1p, exp and the relative
// error of lambda (t exp(-t) <= 1/e): sqrt(alpha) 2^-53 times at most 34 and, for large alpha, 15.
double phongBound(double alpha) { return steepest(alpha) * 24 * u + 4 * u; }
double blinnBound(double alpha, double sum) { return steepest(alpha) * (6 + 7 / sum) * u + 4 * u; }

class Geometry {
 public:
  explicit Geometry(unsigned seed) : random_(seed) {}

  glm::vec3 direction() {
    return glm::vec3(float(normal_(random_)), float(normal_(random_)), float(normal_(random_)));
  }
  /// A float vector near `around`, off by about `spread`, and not unit.
  glm::vec3 near(const dvec3& around, double spread) {
    const dvec3 v = around + spread * dvec3(direction());
    return glm::vec3(v * std::exp2(normal_(random_)));
  }

 private:
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
};

const double exponents[] = {1.0, 2.5, 10.0, 100.0, 1e3, 1e4, 1e5, 1e6};

TEST(Lobe, PhongIsOffByRootAlphaOnly) {
  Geometry geometry(1);
  for (const double alpha : exponents) {
    for (int i = 0; i < 200; ++i) {
      const glm::vec3 n = geometry.direction(), l = geometry.direction();
      const dvec3 N = glint::safeNormalize(n), L = glint::safeNormalize(l);
      const dvec3 R = 2.0 * glm::dot(N, L) * N - L;
      const glm::vec3 v = geometry.near(R, 1.0 / std::sqrt(alpha));
      const dvec3 V = glint::safeNormalize(v);
      const Real cosine = phongCosine(Vector(n), Vector(l), Vector(v));
      const double lambda = glint::phongLambda(N, L, V);
      const double got = glint::lobeExact(lambda, alpha);
      ASSERT_LE(abs(Real(got) - lobeTruth(cosine, alpha)), phongBound(alpha)) << alpha;
      ASSERT_LE(abs(Real(lambda) - (1 - cosine)),
                24 * u * std::sqrt(2 * lambda) + 16 * u * lambda + 600 * u * u);
    }
  }
}

TEST(Lobe, BlinnIsOffByRootAlphaOnly) {
  Geometry geometry(2);
  for (const double alpha : exponents) {
    for (int i = 0; i < 200; ++i) {
      const glm::vec3 l = geometry.direction(), v = geometry.direction();
      const dvec3 L = glint::safeNormalize(l), V = glint::safeNormalize(v);
      const glm::vec3 n = geometry.near(glint::safeNormalize(L + V), 1.0 / std::sqrt(alpha));
      const dvec3 N = glint::safeNormalize(n);
      const Real cosine = blinnCosine(Vector(n), Vector(l), Vector(v));
      const double got = glint::lobeExact(glint::blinnLambda(N, L, V), alpha);
      ASSERT_LE(abs(Real(got) - lobeTruth(cosine, alpha)), blinnBound(alpha, glm::length(L + V)))
          << alpha;
    }
  }
}

// pow of the dot product is the same lobe in double, off by alpha u: D3, D4 in another precision.
TEST(Lobe, PowIsOffByAlpha) {
  Geometry geometry(3);
  for (const double alpha : exponents) {
    for (int i = 0; i < 200; ++i) {
      const glm::vec3 a = geometry.direction();
      const dvec3 A = glint::safeNormalize(a);
      const glm::vec3 b = geometry.near(A, 1.0 / std::sqrt(alpha));
      const dvec3 B = glint::safeNormalize(b);
      const Real exact = lobeTruth(dot(Vector(a), Vector(b)), alpha);
      // two lengths of 2.5 u and a dot product of 2 u; the clamp can only help
      ASSERT_LE(abs(Real(glint::lobePow(glm::dot(A, B), alpha)) - exact), (7 * alpha + 4) * u);
    }
  }
}

struct Vectors {
  dvec3 N, L, V;
  double NoL, RoV, NoH, lambda, phong10, phong100, blinn40, blinn400, lyon10, lyon100;
};

// docs/science.md 8.4: 40 digits rounded to 10 significant ones.
TEST(Lobe, ReproducesTheTestVectors) {
  const Vectors rows[] = {
      {{0, 0, 1}, {1, 2, 2}, {-1, -2, 2}, 0.6666666667, 1, 1, 0, 1, 1, 1, 1, 1, 1},
      {{0, 0, 1},
       {1, 2, 2},
       {0, 0, 1},
       0.6666666667,
       0.6666666667,
       0.9128709292,
       0.3333333333,
       0.01734152992,
       2.459654427e-18,
       0.0260840533,
       1.457977395e-16,
       0.01340708466,
       0},
      {{1, 1, 1},
       {1, 0, 0},
       {0, 1, 0},
       0.5773502692,
       0.6666666667,
       0.8164965809,
       0.3333333333,
       0.01734152992,
       2.459654427e-18,
       0.0003007286598,
       6.0499e-36,
       0.01340708466,
       0},
      {{1, 2, 3},
       {2, 1, 4},
       {0, 1, 1},
       0.9331389496,
       0.9919501069,
       0.9977449808,
       0.008049893101,
       0.9223553807,
       0.4456386565,
       0.9136546485,
       0.4053411374,
       0.9222797606,
       0.4280866182},
      {{0, 0, 1},
       {3, 0, 4},
       {-3, 0.3, 4},
       0.8,
       0.9982048455,
       0.9992986493,
       0.001795154534,
       0.9821927787,
       0.8355402348,
       0.9723262626,
       0.7553011789,
       0.9821888116,
       0.8339680285},
      {{0, 0, 1},
       {1, 0, -0.1},
       {-1, 0, 0.1},
       -0.09950371902,
       0.9801980198,
       0,
       0.0198019802,
       0.8187252946,
       0.1353262606,
       0,
       0,
       0.8183118754,
       0.1027868952}};
  // relative to the value: half a unit of 10 digits; 6.0499e-36 has five
  const auto expectDigits = [](double got, double printed) {
    const double relative = printed == 6.0499e-36 ? 1e-5 : 6e-10;
    EXPECT_NEAR(got, printed, relative * printed + 1e-15 * (printed == 0.0 || printed == 1.0));
  };
  for (const Vectors& row : rows) {
    const dvec3 N = glint::safeNormalize(row.N), L = glint::safeNormalize(row.L),
                V = glint::safeNormalize(row.V);
    EXPECT_NEAR(glm::dot(N, L), row.NoL, 6e-11);
    const double phong = glint::phongLambda(N, L, V);
    EXPECT_NEAR(1.0 - phong, row.RoV, 6e-11);
    expectDigits(phong, row.lambda);
    expectDigits(glint::lobeExact(phong, 10), row.phong10);
    expectDigits(glint::lobeExact(phong, 100), row.phong100);
    expectDigits(glint::lobePow(1.0 - phong, 100), row.phong100);
    expectDigits(glint::lyon(phong, 10, 8), row.lyon10);
    expectDigits(glint::lyon(phong, 100, 8), row.lyon100);
    const double blinn = glint::blinnLambda(N, L, V);
    if (row.NoH > 0.0) {
      EXPECT_NEAR(1.0 - blinn, row.NoH, 6e-11);
    }
    expectDigits(glint::lobeExact(blinn, 40), row.blinn40);
    expectDigits(glint::lobeExact(blinn, 400), row.blinn400);
  }
}

double byName(int form, double lambda, double alpha) {
  return glint::lobe(glint::Highlight(form), 8, lambda, alpha);
}
constexpr int forms = int(glint::Highlight::none);

TEST(Lobe, NamedCases) {
  const dvec3 z(0, 0, 1);
  const dvec3 L = glm::normalize(dvec3(1, 2, 2));
  const dvec3 R(-L.x, -L.y, L.z);
  EXPECT_EQ(glint::phongLambda(z, z, z), 0.0);                                 // C1
  EXPECT_EQ(glint::blinnLambda(z, z, z), 0.0);                                 // C1
  EXPECT_EQ(glint::phongLambda(z, L, R), 0.0);                                 // C5
  EXPECT_NEAR(glint::phongLambda(z, L, -R), 2.0, 8 * u);                       // C6
  EXPECT_EQ(glint::blinnLambda(z, L, -L), glint::noLobe);                      // C7
  EXPECT_EQ(glint::blinnLambda(z, L, -L + dvec3(1e-7, 0, 0)), glint::noLobe);  // C8
  EXPECT_LT(glint::blinnLambda(z, L, -L + dvec3(2e-6, 0, 0)), 2.0 + 8 * u);
  for (int form = 0; form < forms; ++form) {
    for (const double alpha : {0.0, 0.5, 1.0, 8.0, 100.0, 1e6}) {
      EXPECT_EQ(byName(form, 0.0, alpha), 1.0) << form << ' ' << alpha;
      EXPECT_EQ(byName(form, glint::noLobe, alpha), 0.0) << form;
      EXPECT_EQ(byName(form, nan, alpha), 0.0) << form;
    }
    for (const double alpha : {0.0, -1.0, nan}) {  // D1, D2, D5
      EXPECT_EQ(byName(form, 0.999, alpha), 1.0) << form;
      EXPECT_EQ(byName(form, 1.0, alpha), 0.0) << form;
      EXPECT_EQ(byName(form, 2.0, alpha), 0.0) << form;
    }
  }
  EXPECT_EQ(glint::lobeExact(1.5, 2.5), 0.0);                 // D6
  EXPECT_EQ(glint::lobePow(-0.5, 2.5), 0.0);                  // D6
  EXPECT_EQ(glint::lobePow(1.0 + 0x1p-23, 1e6), 1.0);         // D10
  EXPECT_EQ(glint::lobePow(0.0, 0.0), 0.0);                   // D1
  EXPECT_LT(glint::lobeExact(0.5, 2000.0), 1e-300);           // D11
  EXPECT_EQ(glint::lyon(1.0 - std::cos(0.09), 1e3, 4), 0.0);  // D9: cut off at 5.1 degrees
  // D3: the half maximum of alpha = 1e6 is at 0.067 degrees
  EXPECT_NEAR(glint::lobeExact(1.0 - std::cos(0.0674593 * 3.14159265 / 180.0), 1e6), 0.5, 1e-3);
}

TEST(Lobe, IsTotalAndWithinTheUnitInterval) {
  const double odd[] = {0.0, -0.0, -1.0, 1e-320, 1e-9,     0.5,       1.0, 1.5,
                        2.0, 1e3,  1e6,  1e308,  infinity, -infinity, nan};
  for (int form = 0; form < forms; ++form) {
    for (const int gamma : {-8, 0, 1, 2, 3, 64, 1 << 30}) {
      for (const double lambda : odd) {
        for (const double alpha : odd) {
          const double value = glint::lobe(glint::Highlight(form), gamma, lambda, alpha);
          EXPECT_TRUE(value >= 0.0 && value <= 1.0)
              << form << ' ' << gamma << ' ' << lambda << ' ' << alpha;
        }
      }
    }
  }
}

}  // namespace lobe_test
