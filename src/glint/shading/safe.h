#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

namespace glint {

/// x within [low, high]; NaN gives low, so that the result is always finite.
constexpr double clampTo(double x, double low, double high) {
  return x > low ? (x < high ? x : high) : low;
}

/// The largest component, with its sign.
constexpr double largest(const glm::dvec3& v) { return std::max({v.x, v.y, v.z}); }

/// v / |v|. Scaled by the largest component first, so that no square under- or overflows: correct
/// for every length from the smallest subnormal to the largest double. The zero vector, and a
/// vector with a component that is NaN or infinite, give the zero vector, which every formula here
/// takes as "no direction".
inline glm::dvec3 safeNormalize(const glm::dvec3& v) {
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  const bool usable =
      largest > 0.0 && std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
  if (!usable) return glm::dvec3(0.0);
  const glm::dvec3 scaled = v / largest;
  return scaled / std::sqrt(glm::dot(scaled, scaled));
}

}  // namespace glint
