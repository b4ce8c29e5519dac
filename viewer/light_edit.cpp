#include "light_edit.h"

#include <algorithm>
#include <utility>

#include "glint/render/variant.h"
#include "glint/scene/lights.h"

namespace glint::viewer {
namespace {

constexpr double mostIntensity = 1e6;  // of a light given as an option

double squareTo(const Light& light, const Bounds& bounds) {
  const glm::dvec3 way = light.position - bounds.center;
  const double square = glm::dot(way, way);
  return square > 0 ? square : 1;
}

bool tooBright(const Light& light) {
  return std::max({light.intensity.r, light.intensity.g, light.intensity.b}) > mostIntensity;
}

}  // namespace

bool lightsAreTheFiles(const Scene* scene, const Look& look) {
  return !look.light && !look.noLights && scene && !scene->lights.empty();
}

std::vector<Light> shownLights(const Scene* scene, const Look& look) {
  return lightsOf(scene ? withFileLights(*scene, look) : look);
}

std::string setLights(Look& look, const Scene* scene, const Bounds& bounds,
                      std::vector<Light> lights) {
  const bool takenOver = lightsAreTheFiles(scene, look);
  std::size_t changed = 0;
  if (takenOver)
    for (Light& light : lights) {
      if (light.fallsOff && tooBright(light)) {
        setFallOff(light, false, bounds);
        ++changed;
      }
      light.intensity = glm::min(light.intensity, mostIntensity);
    }
  look.noLights = false;
  look.light = std::move(lights);
  if (!takenOver) return {};
  if (changed == 0) return "the file's lights are your own now";
  return "the file's lights are your own now; " + std::to_string(changed) +
         (changed == 1 ? " no longer falls" : " no longer fall") +
         " off: above 1e6 at one unit, so set to the intensity at the model's centre";
}

void setFallOff(Light& light, bool on, const Bounds& bounds) {
  if (light.fallsOff == on) return;
  const double square = squareTo(light, bounds);
  light.intensity =
      glm::clamp(on ? light.intensity * square : light.intensity / square, 0.0, mostIntensity);
  light.fallsOff = on;
  light.range = 0;
}

void changeType(Light& light, Light::Type type, const Bounds& bounds, const glm::dmat3& axes) {
  const double reach = bounds.radius > 0 ? 2.5 * bounds.radius : 2.5;
  glm::dvec3 toLight(0, 0, 1);  // from the model's centre, world space
  switch (light.type) {
    case Light::Type::directional:
      toLight = light.direction;
      break;
    case Light::Type::camera:
      toLight = axes * light.direction;
      break;
    case Light::Type::point:
    case Light::Type::spot:
      toLight = light.position - bounds.center;
      break;
  }
  const double length = glm::length(toLight);
  toLight = length > 0 ? toLight / length : glm::dvec3(0, 0, 1);
  const auto tidy = [](glm::dvec3 v) { return glm::round(v * 1e4) / 1e4; };
  const bool had = light.type == Light::Type::point || light.type == Light::Type::spot;
  const bool has = type == Light::Type::point || type == Light::Type::spot;
  if (!has) setFallOff(light, false, bounds);
  light.type = type;
  if (type == Light::Type::directional) light.direction = tidy(toLight);
  if (type == Light::Type::camera) light.direction = {0, 0, 1};
  if (has && !had) light.position = tidy(bounds.center + toLight * reach);
  if (type == Light::Type::spot) {
    light.direction = tidy(-toLight);
    light.innerAngle = std::min(light.innerAngle, 20.0);
    light.outerAngle = 30;
    if (light.innerAngle <= 0) light.innerAngle = 15;
  }
}

void switchLight(std::vector<Light>& lights, std::size_t i, SwitchedOff& off) {
  Light& light = lights[i];
  const glm::dvec3 dark(0.0);
  if (light.intensity != dark) {
    off[i] = std::exchange(light.intensity, dark);
    return;
  }
  const auto found = off.find(i);
  light.intensity = found == off.end() ? glm::dvec3(1.0) : found->second;
  off.erase(i);
}

void soloLight(std::vector<Light>& lights, std::size_t i, SwitchedOff& off) {
  const auto isOn = [](const Light& light) { return light.intensity != glm::dvec3(0.0); };
  bool alone = isOn(lights[i]);
  for (std::size_t k = 0; k < lights.size(); ++k) alone = alone && (k == i || !isOn(lights[k]));
  for (std::size_t k = 0; k < lights.size(); ++k) {
    const bool on = alone ? isOn(lights[k]) || off.contains(k) : k == i;
    if (on != isOn(lights[k])) switchLight(lights, k, off);
  }
}

Light anotherLight(const Light& from, const Bounds& bounds, const glm::dmat3& axes) {
  Light light = from;
  if (light.type == Light::Type::directional || light.type == Light::Type::camera) {
    changeType(light, Light::Type::directional, bounds, axes);
    light.direction.x = -light.direction.x;
  } else {
    light.position.x = 2 * bounds.center.x - light.position.x;
    light.direction.x = -light.direction.x;
  }
  return light;
}

}  // namespace glint::viewer
