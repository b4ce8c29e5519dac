#include "glint/shading/environment_map.h"

#include <algorithm>
#include <cmath>

#include "glint/shading/safe.h"

namespace glint {
namespace {

double smoothStep(double a, double b, double x) {
  const double t = clampTo((x - a) / (b - a), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

double squared(double x) { return x * x; }

glm::dvec3 sky(const glm::dvec3& d) {
  const SkyConstants& k = skyConstants;
  const double low = std::max(1.0 - std::max(d.y, 0.0), 0.0);
  const double haze = low * low * low;
  const glm::dvec3 air = k.zenith + (k.horizon - k.zenith) * haze;
  const double cosSun = glm::dot(d, k.sun);
  const glm::dvec3 off = d - k.sun;
  const double g8 = squared(squared(squared(std::max(cosSun, 0.0))));
  const double g64 = squared(squared(squared(g8)));
  const double glow =
      k.wide * g8 + k.narrow * g64 +
      k.disc * (1.0 - smoothStep(k.discInner, k.discOuter, 0.5 * glm::dot(off, off)));
  const glm::dvec3 ground =
      k.groundHorizon + (k.groundNadir - k.groundHorizon) * std::max(-d.y, 0.0);
  const glm::dvec3 above = air + glow * k.sunColor;
  return ground + (above - ground) * smoothStep(-k.edge, k.edge, d.y);
}

double within(double p, double half, double soft) {
  return 1.0 - smoothStep(half - soft, half + soft, std::abs(p));
}

double box(const glm::dvec3& d, const BoxLight& light) {
  return smoothStep(0.0, 0.3, glm::dot(d, light.axis)) *
         within(glm::dot(d, light.right), light.halfWidth, light.soft) *
         within(glm::dot(d, light.up), light.halfHeight, light.soft);
}

glm::dvec3 studio(const glm::dvec3& d) {
  const StudioConstants& k = studioConstants;
  const double wall = k.wall + k.backdrop * squared(std::max(-d.z, 0.0));
  const double room = k.floor + (wall - k.floor) * smoothStep(k.floorLow, k.floorHigh, d.y) +
                      k.ceiling * smoothStep(0.0, 1.0, d.y);
  glm::dvec3 radiance = glm::dvec3(room) + squared(std::max(-d.y, 0.0)) * k.bounce;
  for (const BoxLight& light : k.lights) radiance += box(d, light) * light.color;
  return radiance;
}

}  // namespace

glm::dvec3 environmentRadiance(BuiltinEnvironment environment, const glm::dvec3& direction) {
  const glm::dvec3 d = safeNormalize(direction);
  switch (environment) {
    case BuiltinEnvironment::white:
      return glm::dvec3(1.0);
    case BuiltinEnvironment::sky:
      return sky(d);
    case BuiltinEnvironment::studio:
      return studio(d);
  }
  return glm::dvec3(1.0);
}

}  // namespace glint
