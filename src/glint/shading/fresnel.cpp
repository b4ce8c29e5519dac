#include "glint/shading/fresnel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "glint/shading/safe.h"

namespace glint {
namespace {

double validIndex(double n) { return std::isnan(n) ? 1.0 : clampTo(n, 1e-9, 1e9); }

/// n < 1 and steep: 1 - c^2 is small there, and keeps its digits if computed as (1 - c)(1 + c).
bool steepFromDenser(double c, const FresnelConstants& k) { return k.n < 1.0 && c * c > 0.5; }

/// g^2 = n^2 cos^2(theta_t) = n^2 - 1 + c^2; not positive in total reflection.
double gSquared(double c, const FresnelConstants& k) {
  return steepFromDenser(c, k) ? k.nSquared - (1.0 - c) * (1.0 + c) : k.e + c * c;
}

/// The cosine on the thinner side, in terms of which Schlick's family is written; empty for total
/// reflection.
std::optional<double> thinnerCosine(double c, const FresnelConstants& k) {
  if (k.n >= 1.0) return c;
  const double g2 = gSquared(c, k);
  if (g2 <= 0.0) return std::nullopt;
  return std::min(std::sqrt(g2) / k.n, 1.0);
}

double fifthPower(double x) {
  const double x2 = x * x;
  return x2 * x2 * x;
}

/// The common part of Schlick's family: edge cases, and the falling function in place of (1 - c)^5.
template <class Fall>
double schlickWith(double cosTheta, const FresnelConstants& k, Fall fall) {
  if (k.e == 0.0) return 0.0;
  const auto c = thinnerCosine(clampTo(cosTheta, 0.0, 1.0), k);
  if (!c || *c == 0.0) return 1.0;
  return clampTo(k.r0 + (1.0 - k.r0) * fall(*c), 0.0, 1.0);
}

FresnelConstants fromThinner(double n1, double n2) {
  return fresnelConstants(std::min(n1, n2), std::max(n1, n2));
}

}  // namespace

FresnelConstants fresnelConstants(double n1, double n2) {
  n1 = validIndex(n1);
  n2 = validIndex(n2);
  const double d = (n2 - n1) / n1;
  FresnelConstants k;
  k.n = n2 / n1;
  // Below 0.7 squaring directly is more accurate: 1 + e would cancel.
  const bool direct = k.n < 0.7;
  k.e = direct ? k.n * k.n - 1.0 : d * (2.0 + d);
  k.nSquared = direct ? k.n * k.n : 1.0 + k.e;
  k.nSquaredPlus1 = k.nSquared + 1.0;
  const double amplitude = d / (2.0 + d);
  k.r0 = amplitude * amplitude;
  return k;
}

FresnelSides fresnelSides(double ior, double mediumIor) {
  return {fresnelConstants(mediumIor, ior), fresnelConstants(ior, mediumIor)};
}

PolarizedReflectance fresnelPolarized(double cosTheta, const FresnelConstants& k) {
  if (k.e == 0.0) return {0.0, 0.0};
  const double c = clampTo(cosTheta, 0.0, 1.0);
  const double g2 = gSquared(c, k);
  if (g2 <= 0.0 || c == 0.0) return {1.0, 1.0};
  const double g = std::sqrt(g2);
  const double q = steepFromDenser(c, k) ? k.nSquared * c * c - (1.0 - c) * (1.0 + c)
                                         : k.nSquaredPlus1 * c * c - 1.0;
  const double s = c + g;
  const double p = k.nSquared * c + g;
  const double rs = k.e / (s * s);
  const double rp = k.e * q / (p * p);
  return {std::min(rs * rs, 1.0), std::min(rp * rp, 1.0)};
}

PolarizedReflectance fresnelPolarized(double cosTheta, double n1, double n2) {
  return fresnelPolarized(cosTheta, fresnelConstants(n1, n2));
}

double fresnelExact(double cosTheta, const FresnelConstants& k) {
  const PolarizedReflectance r = fresnelPolarized(cosTheta, k);
  return 0.5 * (r.perpendicular + r.parallel);
}

double fresnelExact(double cosTheta, double n1, double n2) {
  return fresnelExact(cosTheta, fresnelConstants(n1, n2));
}

double fresnelTextbook(double cosTheta, double n1, double n2) {
  n1 = validIndex(n1);
  n2 = validIndex(n2);
  if (n1 == n2) return 0.0;
  const double ci = clampTo(cosTheta, 0.0, 1.0);
  const double eta = n1 / n2;
  const double sin2t = eta * eta * (1.0 - ci * ci);
  if (sin2t >= 1.0) return 1.0;
  const double ct = std::sqrt(1.0 - sin2t);
  const double perpendicular = (n1 * ci - n2 * ct) / (n1 * ci + n2 * ct);
  const double parallel = (n2 * ci - n1 * ct) / (n2 * ci + n1 * ct);
  return std::min(0.5 * (perpendicular * perpendicular + parallel * parallel), 1.0);
}

double schlick(double cosTheta, const FresnelConstants& k, double exponent) {
  exponent = clampTo(exponent, 0.0, 1e6);
  return schlickWith(cosTheta, k, [exponent](double c) {
    return exponent == 5.0 ? fifthPower(1.0 - c) : std::pow(1.0 - c, exponent);
  });
}

double schlick(double cosTheta, double n1, double n2, double exponent) {
  return schlick(cosTheta, fresnelConstants(n1, n2), exponent);
}

double schlickExp2(double cosTheta, const FresnelConstants& k) {
  return schlickWith(cosTheta, k, [](double c) { return std::exp2((-5.55473 * c - 6.98316) * c); });
}

double schlickExp2(double cosTheta, double n1, double n2) {
  return schlickExp2(cosTheta, fresnelConstants(n1, n2));
}

double schlickRational(double cosTheta, const FresnelConstants& constants, double k) {
  k = std::max(k, 0.0);
  return schlickWith(cosTheta, constants, [k](double c) {
    const double ratio = (1.0 - c) / (1.0 + k * c);
    return ratio * ratio;
  });
}

double rationalSlope(double n1, double n2) {
  const FresnelConstants k = fromThinner(n1, n2);
  if (k.e == 0.0) return 0.0;
  const double n = k.n;
  return (n + 1.0) * (n + 1.0) * k.nSquaredPlus1 / (4.0 * n * std::sqrt(k.e)) - 1.0;
}

double rationalMinimax(double n1, double n2) {
  const FresnelConstants constants = fromThinner(n1, n2);
  if (constants.e == 0.0) return 0.0;
  // At grazing R falls from 1 as 1 - 2 c / scale, so half of the samples are at c < scale.
  const double scale = std::sqrt(constants.e) / constants.nSquaredPlus1;
  struct Sample {
    double c, exact;
  };
  constexpr std::size_t count = 512;
  std::array<Sample, count> samples;
  for (std::size_t i = 0; i < count; ++i) {
    const double t = (double(i) + 0.5) / double(count);
    const double c = scale * t / (1.0 - t + scale * t);
    samples[i] = {c, fresnelExact(c, constants)};
  }
  double low = 0.0;
  double high = 64.0 * (rationalSlope(n1, n2) + 1.0);
  while (high - low > 1e-7 * high) {
    const double k = 0.5 * (low + high);
    double over = 0.0;
    double under = 0.0;
    for (const Sample& s : samples) {
      const double error = schlickRational(s.c, constants, k) - s.exact;
      over = std::max(over, error);
      under = std::min(under, error);
    }
    (over + under > 0.0 ? low : high) = k;
  }
  return 0.5 * (low + high);
}

double criticalCosine(double n1, double n2) {
  return std::sqrt(std::max(-fresnelConstants(n1, n2).e, 0.0));
}

double brewsterAngle(double n1, double n2) { return std::atan2(validIndex(n2), validIndex(n1)); }

glm::dvec3 metalReflectance(double cosTheta, const glm::dvec3& color) {
  return color + (1.0 - color) * fifthPower(1.0 - clampTo(cosTheta, 0.0, 1.0));
}

glm::dvec3 reflect(const glm::dvec3& incident, const glm::dvec3& normal) {
  return incident - 2.0 * glm::dot(incident, normal) * normal;
}

std::optional<glm::dvec3> refract(const glm::dvec3& incident, const glm::dvec3& normal, double n1,
                                  double n2) {
  const FresnelConstants k = fresnelConstants(n1, n2);
  if (k.e == 0.0) return incident;
  const double c = -glm::dot(incident, normal);
  if (gSquared(clampTo(c, 0.0, 1.0), k) <= 0.0) return std::nullopt;
  const glm::dvec3 tangential = (incident + c * normal) / k.n;
  const double normalPart = std::sqrt(std::max(1.0 - glm::dot(tangential, tangential), 0.0));
  return tangential - normalPart * normal;
}

}  // namespace glint
