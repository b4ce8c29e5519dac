#include "glint/stability/scenes.h"

#include <cmath>

#include "glint/shading/safe.h"
#include "glint/stability/bench.h"

namespace glint::stability {

Mesh square(const glm::dvec3& normal, float half) {
  Mesh mesh;
  mesh.positions = {{-half, -half, 0}, {half, -half, 0}, {half, half, 0}, {-half, half, 0}};
  mesh.normals.assign(4, glm::vec3(safeNormalize(normal)));
  mesh.indices = {0, 1, 2, 0, 2, 3};
  return mesh;
}

Mesh sphere(int around, int down) {
  Mesh mesh;
  for (int j = 0; j <= down; ++j)
    for (int i = 0; i <= around; ++i) {
      const double theta = pi * j / down, phi = 2 * pi * i / around;
      const glm::dvec3 p(std::sin(theta) * std::cos(phi), std::cos(theta),
                         -std::sin(theta) * std::sin(phi));
      mesh.positions.emplace_back(p);
      mesh.normals.emplace_back(safeNormalize(p));
    }
  const auto at = [&](int i, int j) { return std::uint32_t(j * (around + 1) + i); };
  for (int j = 0; j < down; ++j)
    for (int i = 0; i < around; ++i) {
      if (j > 0) mesh.indices.insert(mesh.indices.end(), {at(i, j), at(i, j + 1), at(i + 1, j)});
      if (j < down - 1)
        mesh.indices.insert(mesh.indices.end(), {at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)});
    }
  return mesh;
}

Mesh triangles(std::vector<glm::vec3> positions) {
  Mesh mesh;
  mesh.positions = std::move(positions);
  mesh.normals.assign(mesh.positions.size(), glm::vec3(0, 0, 1));
  for (std::uint32_t i = 0; i < mesh.positions.size(); ++i) mesh.indices.push_back(i);
  return mesh;
}

Mesh thinTriangles(float step) {
  std::vector<glm::vec3> corners;
  for (int i = 0; i < 12; ++i) {
    const float y = -0.9f + 0.15f * float(i), x = step * float(i);
    corners.insert(corners.end(),
                   {{x - 0.03f, y, 0}, {x + 0.03f, y + 0.02f, 0}, {x - 0.02f, y + 0.1f, 0}});
  }
  return triangles(std::move(corners));
}

Mesh pebble() {
  Mesh mesh = sphere(24, 12);
  for (glm::vec3& p : mesh.positions) p *= glm::vec3(1, 0.8f, 0.9f);
  return mesh;
}

Material paint() {
  Material material;
  material.shading = {0.5, 0.7, 0.4, 30, 0, 1.5, {0.9, 0.6, 0.3}};
  return material;
}

Scene sceneOf(Mesh mesh, Material material, const glm::dmat4& world) {
  Scene scene;
  scene.name = "case";
  scene.meshes.push_back(std::move(mesh));
  scene.materials.push_back(std::move(material));
  scene.instances.push_back({0, world});
  return scene;
}

Material unlitMaterial(const glm::dvec3& color) {
  Material material;
  material.shading.color = color;
  material.unlit = true;
  return material;
}

Look parallel(Look look, const glm::dvec3& toViewer, int pixels) {
  look.cameraPosition = toViewer * (4 / std::sqrt(glm::dot(toViewer, toViewer)));
  look.cameraFocalPoint = glm::dvec3(0);
  look.cameraViewAngle = 2 * std::atan(0.25) / degrees;
  look.cameraOrthographic = true;
  look.resolution = {pixels, pixels};
  return look;
}

Light directional(const glm::dvec3& toLight, const glm::dvec3& intensity) {
  Light light;
  light.direction = toLight;
  light.intensity = intensity;
  return light;
}

Light spotAlong(const glm::dvec3& direction, double innerAngle, double outerAngle) {
  Light light = directional(direction);
  light.type = Light::Type::spot;
  light.innerAngle = innerAngle;
  light.outerAngle = outerAngle;
  return light;
}

glm::dmat4 translation(const glm::dvec3& t) {
  glm::dmat4 m(1);
  m[3] = glm::dvec4(t, 1);
  return m;
}

glm::dmat4 scaling(const glm::dvec3& s) {
  glm::dmat4 m(1);
  for (int i = 0; i < 3; ++i) m[i][i] = s[i];
  return m;
}

glm::dmat4 rotation(double angle) {
  const glm::dvec3 a = safeNormalize({0.3, 0.8, -0.5});
  const double c = std::cos(angle), s = std::sin(angle);
  glm::dmat4 m(1);
  for (int i = 0; i < 3; ++i) {
    glm::dvec3 e(0);
    e[i] = 1;
    m[i] = glm::dvec4(e * c + glm::cross(a, e) * s + a * (a[i] * (1 - c)), 0);
  }
  return m;
}

double Random::unit() {
  // Knuth's linear congruential generator; its upper 53 bits.
  state_ = state_ * 6364136223846793005ull + 1442695040888963407ull;
  return double(state_ >> 11) * (1.0 / 9007199254740992.0);
}

std::vector<glm::dvec3> randomDirections(std::size_t count, unsigned seed) {
  Random random(seed);
  std::vector<glm::dvec3> all;
  for (std::size_t i = 0; i < count; ++i) {
    const double z = random.between(-1, 1), phi = random.between(0, 2 * pi);
    const double r = std::sqrt(1 - z * z);
    all.emplace_back(r * std::cos(phi), r * std::sin(phi), z);
  }
  return all;
}

}  // namespace glint::stability
