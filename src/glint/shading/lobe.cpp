#include "glint/shading/lobe.h"

#include <algorithm>
#include <cmath>

#include "glint/shading/safe.h"

namespace glint {
namespace {

constexpr int largestGamma = 64;

/// x^gamma by squaring.
double powerOfTwo(double x, int gamma) {
  for (int g = std::min(gamma, largestGamma); g > 1; g /= 2) x *= x;
  return x;
}

/// The power of two to which powerOfTwo raises.
int validGamma(int gamma) {
  int valid = 1;
  while (2 * valid <= std::min(gamma, largestGamma)) valid *= 2;
  return valid;
}

/// The edge cases that all forms share, and the form itself for the rest: lambda in [0, 2],
/// alpha > 0.
template <class Form>
double lobeWith(double lambda, double alpha, Form form) {
  if (!(lambda < noLobe)) return 0.0;
  if (!(alpha > 0.0)) return lambda < 1.0 ? 1.0 : 0.0;
  return form(clampTo(lambda, 0.0, 2.0), std::min(alpha, 1e12));
}

}  // namespace

double phongLambda(const glm::dvec3& N, const glm::dvec3& L, const glm::dvec3& V) {
  const glm::dvec3 D = (L + V) - (2.0 * glm::dot(N, L)) * N;
  return 0.5 * glm::dot(D, D);
}

double blinnLambda(const glm::dvec3& N, const glm::dvec3& L, const glm::dvec3& V) {
  const glm::dvec3 sum = L + V;
  const double squared = glm::dot(sum, sum);
  if (!(squared > opposedLimit)) return noLobe;
  const glm::dvec3 D = N - sum / std::sqrt(squared);
  return 0.5 * glm::dot(D, D);
}

double lobeExact(double lambda, double alpha) {
  return lobeWith(lambda, alpha,
                  [](double x, double a) { return x < 1.0 ? std::exp(a * std::log1p(-x)) : 0.0; });
}

double lobePow(double dot, double alpha) {
  if (!(dot > 0.0)) return 0.0;
  return alpha > 0.0 ? std::pow(std::min(dot, 1.0), alpha) : 1.0;
}

bool isIntegerPower(double alpha) {
  return alpha >= 1.0 && alpha <= 128.0 && alpha == std::floor(alpha);
}

double lobeInteger(double lambda, double alpha) {
  if (!isIntegerPower(alpha)) return lobeExact(lambda, alpha);
  return lobeWith(lambda, alpha, [](double x, double a) {
    double product = 1.0;
    for (int i = 0; i < int(a); ++i) product *= std::max(1.0 - x, 0.0);
    return product;
  });
}

float lobeTableEntry(int place, double alpha, int steps) {
  // In long double, so that rounding gives the nearest float.
  return float(std::pow((long double)(place) / steps, (long double)(alpha)));
}

double lobeTable(double dot, double alpha, int steps) {
  if (!(dot > 0.0)) return 0.0;
  if (!(alpha > 0.0)) return 1.0;
  const double place = std::min(dot, 1.0) * std::max(steps, 1);
  const double below = std::min(std::floor(place), std::max(steps, 1) - 1.0);
  const auto entry = [&](double at) { return std::pow(at / std::max(steps, 1), alpha); };
  return std::lerp(entry(below), entry(below + 1), place - below);
}

double lyon(double lambda, double alpha, int gamma) {
  gamma = validGamma(gamma);
  return lobeWith(lambda, alpha, [gamma](double x, double a) {
    return powerOfTwo(std::max(1.0 - a / gamma * x, 0.0), gamma);
  });
}

double tunedSlope(double alpha, int gamma) { return (alpha * (1.0 - 0.65 / gamma) + 0.65) / gamma; }

double lyonTuned(double lambda, double alpha, int gamma) {
  gamma = validGamma(gamma);
  return lobeWith(lambda, alpha, [gamma](double x, double a) {
    return powerOfTwo(std::max(1.0 - tunedSlope(a, gamma) * x, 0.0), gamma);
  });
}

double lyonCross(double lambda, double alpha, int gamma) {
  gamma = validGamma(gamma);
  return lobeWith(lambda, alpha, [gamma](double x, double a) {
    if (x >= 1.0) return 0.0;
    const double crossLambda = 0.5 * x * (2.0 - x);
    return powerOfTwo(std::max(1.0 - a / gamma * crossLambda, 0.0), gamma);
  });
}

double pade(double lambda, double alpha, int gamma) {
  gamma = validGamma(gamma);
  return lobeWith(lambda, alpha, [gamma](double x, double a) {
    const double beta = a / gamma;
    const double top = std::max(2.0 - (1.0 + beta) * x, 0.0);
    return top > 0.0 ? powerOfTwo(std::min(top / (2.0 + (beta - 1.0) * x), 1.0), gamma) : 0.0;
  });
}

double gaussian(double lambda, double alpha) {
  return lobeWith(lambda, alpha,
                  [](double x, double a) { return std::exp(-(a + gaussianShift) * x); });
}

}  // namespace glint
