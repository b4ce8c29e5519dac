#pragma once

// The formulas in double, which pictures are compared with. Written for the tests from
// docs/science.md and the literature, independently of src/shading.

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

namespace glint::test {

inline glm::dvec3 unit(const glm::dvec3& v) { return v / std::sqrt(glm::dot(v, v)); }

/// max(R.V, 0)^exponent, R = 2 (N.L) N - L.
inline double phongLobe(const glm::dvec3& n, const glm::dvec3& l, const glm::dvec3& v,
                        double exponent) {
  const double c = glm::dot(2 * glm::dot(n, l) * n - l, v);
  return c > 0 ? std::pow(c, exponent) : 0;
}

/// max(N.H, 0)^exponent, H = (L + V) / |L + V|; 0 where L = -V.
inline double blinnLobe(const glm::dvec3& n, const glm::dvec3& l, const glm::dvec3& v,
                        double exponent) {
  const glm::dvec3 sum = l + v;
  if (!(glm::dot(sum, sum) > 1e-12)) return 0;
  const double c = glm::dot(n, unit(sum));
  return c > 0 ? std::pow(c, exponent) : 0;
}

struct SurfaceValues {
  double ambient, diffuse, specular, exponent, metalness;
  glm::dvec3 color;
};

/// m_a C A + [N.L > 0] (m_d C I N.L + m_s S I lobe) for one white light of intensity 1.
inline glm::dvec3 shaded(const SurfaceValues& m, const glm::dvec3& ambientLight,
                         const glm::dvec3& n, const glm::dvec3& l, const glm::dvec3& v,
                         bool blinn) {
  glm::dvec3 sum = m.ambient * m.color * ambientLight;
  const double cosLight = glm::dot(n, l);
  if (!(cosLight > 0)) return sum;
  const glm::dvec3 shine = m.metalness * m.color + (1 - m.metalness) * glm::dvec3(1);
  const double lobe = blinn ? blinnLobe(n, l, v, 4 * m.exponent) : phongLobe(n, l, v, m.exponent);
  return sum + m.diffuse * m.color * cosLight + m.specular * shine * lobe;
}

/// Fresnel's equations for unpolarised light from n1 to n2, by Snell's law; 1 in total reflection.
inline double reflectance(double cosTheta, double n1, double n2) {
  const double sinT = n1 / n2 * std::sqrt(std::max(0.0, 1 - cosTheta * cosTheta));
  if (sinT >= 1) return 1;
  const double cosT = std::sqrt(1 - sinT * sinT);
  const double s = (n1 * cosTheta - n2 * cosT) / (n1 * cosTheta + n2 * cosT);
  const double p = (n2 * cosTheta - n1 * cosT) / (n2 * cosTheta + n1 * cosT);
  return (s * s + p * p) / 2;
}

/// Half an ulp of float near 1: the relative error of one rounding to float.
inline constexpr double rounding = 1.0 / (1 << 24);

/// The error bound of a lobe drawn in float. Directions carry e = 8 roundings each (a rotation of
/// three products, a normalisation), so D = L + V - 2 (N.L) N is off by at most about 6 e.
/// lambda = |D|^2 / 2 then changes by |D| 6 e, and the lobe (1 - lambda)^a by at most
/// max over D of a |D| exp(-a D^2 / 2) 6 e = sqrt(a / e) 6 e = 0.61 sqrt(a) 6 e. The power itself,
/// exp2 of a logarithm with a relative error of some 4 roundings, adds 4 roundings / e.
inline double lobeTolerance(double exponent) {
  return 0.61 * std::sqrt(exponent) * 48 * rounding + 16 * rounding;
}

}  // namespace glint::test
