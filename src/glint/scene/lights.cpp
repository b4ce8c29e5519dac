#include "glint/scene/lights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "glint/shading/safe.h"

namespace glint {
namespace {

constexpr double degrees = 180 / std::numbers::pi;

/// The fraction of the light that arrives at a point facing it, by KHR_lights_punctual, and the
/// unit vector towards it.
std::pair<double, glm::dvec3> arriving(const FileLight& light, const glm::dvec3& point) {
  if (light.type == FileLight::Type::directional) return {1, -light.direction};
  const glm::dvec3 way = light.position - point;
  const double square = glm::dot(way, way);
  if (!(square > 0)) return {0, {}};
  const glm::dvec3 toLight = way / std::sqrt(square);
  double share = 1 / square;
  if (light.range > 0) {
    const double ratio = square / (light.range * light.range);
    share *= std::max(1 - ratio * ratio, 0.0);
  }
  if (light.type == FileLight::Type::spot) {
    const double inner = std::cos(light.innerAngle), outer = std::cos(light.outerAngle);
    const double ramp = (glm::dot(-toLight, light.direction) - outer) / (inner - outer);
    const double cone = std::clamp(ramp, 0.0, 1.0);
    share *= cone * cone;
  }
  return {share, toLight};
}

bool isLit(const Scene& scene, const Mesh& mesh) {
  return mesh.topology == Topology::triangles && !scene.materials[std::size_t(mesh.material)].unlit;
}

/// Accumulates the light that arrives at points of the surface.
class Meter {
 public:
  explicit Meter(const Scene& scene) : scene_(scene), sums_(scene.lights.size(), 0.0) {}

  void add(const glm::dvec3& point, const glm::dvec3& normal, bool bothSides, double area) {
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < scene_.lights.size(); ++i) {
      const FileLight& light = scene_.lights[i];
      const auto [share, toLight] = arriving(light, point);
      double cosine = glm::dot(normal, toLight);
      if (bothSides) cosine = std::abs(cosine);
      if (!(share > 0) || !(cosine > 0)) continue;
      const glm::dvec3 light1 = light.intensity * (share * cosine);
      sum += light1;
      sums_[i] += largest(light1) * area;
    }
    total_ += area;
    if (largest(sum) > 0) points_.emplace_back(largest(sum), area);
  }

  LightMeter result() {
    LightMeter meter;
    meter.shares = std::move(sums_);
    for (double& share : meter.shares) share /= total_ > 0 ? total_ : 1;
    std::ranges::sort(points_);
    double lit = 0, above = 0;
    for (const auto& [value, area] : points_) lit += area;
    for (auto p = points_.rbegin(); p != points_.rend(); ++p) {
      above += p->second;
      if (above < 0.05 * lit) continue;
      meter.scale = std::clamp(1 / p->first, 1e-30, 1e30);
      break;
    }
    return meter;
  }

 private:
  const Scene& scene_;
  std::vector<double> sums_;
  double total_ = 0;
  std::vector<std::pair<double, double>> points_;  ///< light and area
};

}  // namespace

LightMeter meterLights(const Scene& scene) {
  constexpr std::size_t mostPoints = std::size_t(1) << 16;
  std::size_t triangles = 0;
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
    if (isLit(scene, mesh)) triangles += mesh.indices.size() / 3;
  }
  // With many triangles every stride-th is sampled; few are subdivided into cuts x cuts.
  const std::size_t stride = triangles / mostPoints + 1;
  const int cuts = std::clamp(
      int(std::sqrt(double(mostPoints) / 4 / double(std::max<std::size_t>(triangles, 1)))), 1, 32);
  Meter meter(scene);
  std::size_t number = 0;
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
    if (!isLit(scene, mesh)) continue;
    const glm::dmat3 linear(instance.world);
    const glm::dvec3 offset = linear * mesh.origin + glm::dvec3(instance.world[3]);
    const bool mirrored = glm::dot(linear[0], glm::cross(linear[1], linear[2])) < 0;
    const bool bothSides = scene.materials[std::size_t(mesh.material)].doubleSided;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
      if (number++ % stride != 0) continue;
      std::array<glm::dvec3, 3> corner;
      for (std::size_t k = 0; k < 3; ++k) {
        corner[k] = linear * glm::dvec3(mesh.positions[mesh.indices[i + k]]) + offset;
      }
      const glm::dvec3 u = (corner[1] - corner[0]) / double(cuts);
      const glm::dvec3 v = (corner[2] - corner[0]) / double(cuts);
      const glm::dvec3 across = glm::cross(u, v);
      const double area = glm::length(across);
      if (!(area > 0) || !std::isfinite(area)) continue;
      const glm::dvec3 normal = across / (mirrored ? -area : area);
      for (int a = 0; a < cuts; ++a) {
        for (int b = 0; a + b < cuts; ++b) {
          const glm::dvec3 low = corner[0] + double(a) * u + double(b) * v;
          meter.add(low + (u + v) / 3.0, normal, bothSides, area);
          if (a + b + 1 < cuts) meter.add(low + (u + v) * (2 / 3.0), normal, bothSides, area);
        }
      }
    }
  }
  return meter.result();
}

Look withFileLights(const Scene& scene, const Look& look) {
  Look result = look;
  if (look.light || look.noLights || scene.lights.empty()) return result;
  const double scale = look.lightScale.value_or(scene.lightScale);
  result.light.emplace();
  for (const FileLight& from : scene.lights) {
    if (result.light->size() == maxLights) break;
    Light& light = result.light->emplace_back();
    light.intensity = from.intensity * scale;
    light.position = from.position;
    light.direction = from.direction;
    light.range = from.range;
    light.fallsOff = from.type != FileLight::Type::directional;
    switch (from.type) {
      case FileLight::Type::directional:
        light.type = Light::Type::directional;
        light.direction = -from.direction;
        break;
      case FileLight::Type::point:
        light.type = Light::Type::point;
        break;
      case FileLight::Type::spot:
        light.type = Light::Type::spot;
        light.innerAngle = from.innerAngle * degrees;
        light.outerAngle = from.outerAngle * degrees;
        break;
    }
  }
  return result;
}

}  // namespace glint
