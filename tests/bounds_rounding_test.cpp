// The rounding part of the bounds, tested against the shaders' arithmetic in single precision done
// here (additions, products, division and root correctly rounded, as on the software driver). The
// forms used have no formula error, so nothing hides the effect of rounding.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>

#include "glint/shading/bounds.h"

namespace glint::bounds_rounding_test {

int draws(int usual) {
  const char* more = std::getenv("GLINT_BOUND_DRAWS");
  return more != nullptr ? std::max(std::atoi(more), 1) : usual;
}

glm::vec3 unit(const glm::vec3& v) { return v / std::sqrt(glm::dot(v, v)); }

float log1m(float x) {
  const float s = x / (2.0f - x), t = s * s;
  const float series =
      1.0f + t * (1.0f / 3 + t * (0.2f + t * (1.0f / 7 + t * (1.0f / 9 + t * (1.0f / 11)))));
  return x > 0.5f ? std::log2(1.0f - x) * 0.69314718056f : -2.0f * s * series;
}

float powerOf(float x, int power) {
  float p = 1, s = x;
  for (; power > 0; power /= 2, s *= s)
    if (power % 2 == 1) p *= s;
  return p;
}

// Forms without formula error: lyon and pade where alpha is gamma.
float lobeOf(Highlight form, float lambda, float cosine, float alpha) {
  switch (form) {
    case Highlight::pow:
      return cosine > 0 ? std::pow(std::min(cosine, 1.0f), alpha) : 0.0f;
    case Highlight::integer:
      return powerOf(std::max(1.0f - lambda, 0.0f), int(alpha));
    case Highlight::lyon:
      return powerOf(std::max(1.0f - 1.0f * lambda, 0.0f), int(alpha));
    case Highlight::pade: {
      const float top = 2.0f - 2.0f * lambda;
      return top > 0 ? powerOf(top / (2.0f + 0.0f * lambda), int(alpha)) : 0.0f;
    }
    default:
      return lambda < 1.0f ? std::exp2(1.44269504089f * alpha * log1m(lambda)) : 0.0f;
  }
}

struct Random {
  std::mt19937 engine{51};
  double unit() { return std::uniform_real_distribution<double>(0, 1)(engine); }
  double log(double low, double high) { return low * std::pow(high / low, unit()); }
  glm::dvec3 vector() {
    std::normal_distribution<double> n;
    return {n(engine), n(engine), n(engine)};
  }
  glm::dvec3 direction() { return glm::normalize(vector()); }
};

TEST(Bounds, OfRoundingCoverLobesInSinglePrecision) {
  Random r;
  constexpr Highlight forms[] = {Highlight::exact, Highlight::pow, Highlight::integer,
                                 Highlight::lyon, Highlight::pade};
  double nearest[5][2] = {};
  for (int i = 0; i < draws(200000); ++i) {
    const int k = i % 5;
    const bool blinn = i % 2 == 1;
    double alpha = r.log(1, 1e5);
    if (k == 2) alpha = 1 + int(127 * r.unit());
    if (k > 2) alpha = 1 << int(7 * r.unit());
    // Light and viewer in any direction, or almost opposite each other; the normal about one lobe
    // width away from the direction of the highlight.
    const glm::dvec3 L = r.direction();
    const glm::dvec3 V =
        i % 3 == 0 ? glm::normalize(r.log(0.27, 1) * r.direction() - L) : r.direction();
    if (!(glm::length(L + V) > 0.25)) continue;
    const double way = 1.5 * r.unit() / std::sqrt(alpha) / (blinn ? 1 : 2);
    const glm::dvec3 N = glm::normalize(glm::normalize(L + V) + way * r.vector());
    const glm::vec3 n(r.log(0.1, 10) * N), l(r.log(0.1, 10) * L), v(r.log(0.1, 10) * V);
    const glm::dvec3 exactN = glm::normalize(glm::dvec3(n)), exactL = glm::normalize(glm::dvec3(l)),
                     exactV = glm::normalize(glm::dvec3(v));
    if (!(glm::dot(exactN, exactL) > 1e-6)) continue;
    const double lambda =
        blinn ? blinnLambda(exactN, exactL, exactV) : phongLambda(exactN, exactL, exactV);
    const glm::vec3 fn = unit(n), fl = unit(l), fv = unit(v);
    const float cosLight = glm::dot(fn, fl);
    const glm::vec3 between = fl + fv;
    const glm::vec3 half = between / std::sqrt(glm::dot(between, between));
    const glm::vec3 d = blinn ? fn - half : between - (2.0f * cosLight) * fn;
    const float cosine = blinn ? glm::dot(fn, half) : glm::dot(2.0f * cosLight * fn - fl, fv);
    const double error =
        std::abs(double(lobeOf(forms[k], 0.5f * glm::dot(d, d), cosine, float(alpha))) -
                 lobeExact(lambda, double(float(alpha))));
    const double bound = lobeRoundingBound(forms[k], int(alpha), alpha, blinn);
    ASSERT_LE(error, bound) << int(forms[k]) << " alpha " << alpha << (blinn ? " blinn" : "");
    nearest[k][blinn] = std::max(nearest[k][blinn], error / bound);
  }
  for (const auto& each : nearest)
    std::printf("at most %.2f (Phong) and %.2f (Blinn-Phong) of the bound\n", each[0], each[1]);
  for (const auto& each : nearest) {
    EXPECT_GT(each[0], 0.2);
    EXPECT_GT(each[1], 0.04);  // the factor 8 for directions almost opposite each other
  }
}

TEST(Bounds, OfRoundingCoverReflectancesInSinglePrecision) {
  Random r;
  double nearest = 0;
  for (int i = 0; i < draws(60000); ++i) {
    const double ior = r.log(1.02, 3), n1 = i % 2 ? ior : 1, n2 = i % 2 ? 1 : ior;
    const double steep = criticalCosine(n1, n2);
    const double aimed = steep + (1 - steep) * r.log(1e-7, 1);
    const glm::dvec3 N = r.direction();
    const glm::dvec3 across = glm::normalize(glm::cross(N, r.vector()));
    const glm::dvec3 V = aimed * N + std::sqrt(std::max(1 - aimed * aimed, 0.0)) * across;
    const glm::vec3 n(r.log(0.1, 10) * N), v(r.log(0.1, 10) * V);
    const double exact = glm::dot(glm::normalize(glm::dvec3(n)), glm::normalize(glm::dvec3(v)));
    if (!(exact >= steep + criticalRing(n1, n2))) continue;
    const double cosine = glm::dot(unit(n), unit(v));
    const double error = std::abs(fresnelExact(cosine, n1, n2) - fresnelExact(exact, n1, n2));
    const double bound = fresnelRoundingBound(Fresnel::exact, n1, n2);
    ASSERT_LE(error, bound) << n1 << " to " << n2 << " at " << exact;
    nearest = std::max(nearest, error / bound);
  }
  std::printf("at most %.2f of the bound\n", nearest);
  EXPECT_GT(nearest, 0.2);
}

}  // namespace glint::bounds_rounding_test
