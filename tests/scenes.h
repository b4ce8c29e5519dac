#pragma once

// Small scenes and looks that tests build in memory, with known numbers.

#include <cmath>
#include <cstring>
#include <numbers>
#include <utility>

#include "glint/scene/look.h"
#include "glint/scene/scene.h"

namespace glint::test {

inline constexpr double degrees = std::numbers::pi / 180;

/// A square in the plane z = 0, seen from +Z, whose four normals are `normal`.
inline Mesh quad(const glm::dvec3& normal = {0, 0, 1}, float half = 2) {
  Mesh mesh;
  mesh.positions = {{-half, -half, 0}, {half, -half, 0}, {half, half, 0}, {-half, half, 0}};
  mesh.normals.assign(4, glm::vec3(glm::normalize(normal)));
  mesh.indices = {0, 1, 2, 0, 2, 3};
  return mesh;
}

/// The unit sphere by longitude and latitude, with exact normals.
inline Mesh sphere(int around, int down) {
  Mesh mesh;
  for (int j = 0; j <= down; ++j)
    for (int i = 0; i <= around; ++i) {
      const double theta = std::numbers::pi * j / down, phi = 2 * std::numbers::pi * i / around;
      const glm::dvec3 p(std::sin(theta) * std::cos(phi), std::cos(theta),
                         -std::sin(theta) * std::sin(phi));
      mesh.positions.emplace_back(p);
      mesh.normals.emplace_back(glm::normalize(p));
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

/// One mesh with one material and one instance.
inline Scene sceneOf(Mesh mesh, Material material = {}, const glm::dmat4& world = glm::dmat4(1)) {
  Scene scene;
  scene.name = "test";
  scene.meshes.push_back(std::move(mesh));
  scene.materials.push_back(std::move(material));
  scene.instances.push_back({0, world});
  return scene;
}

inline Material materialOf(double ambient, double diffuse, double specular, double exponent,
                           double metalness = 0, const glm::dvec3& color = glm::dvec3(1)) {
  Material material;
  material.shading = {ambient, diffuse, specular, exponent, metalness, 1.5, color};
  return material;
}

/// An orthographic view along -`toViewer` at the origin, 2 units high: every pixel has the same V.
inline Look parallelLook(const glm::dvec3& toViewer = {0, 0, 1}, int pixels = 8) {
  Look look;
  look.cameraPosition = toViewer * (4 / std::sqrt(glm::dot(toViewer, toViewer)));
  look.cameraFocalPoint = glm::dvec3(0);
  look.cameraViewAngle = 2 * std::atan(0.25) / degrees;
  look.cameraOrthographic = true;
  look.resolution = {pixels, pixels};
  look.antiAliasing = {AntiAliasing::Mode::none, 1};
  look.backgroundColor = glm::dvec3(0);
  look.ambientLight = glm::dvec3(0);
  return look;
}

inline Light directional(const glm::dvec3& toLight, const glm::dvec3& intensity = glm::dvec3(1)) {
  Light light;
  light.direction = toLight;
  light.intensity = intensity;
  return light;
}

inline glm::dmat4 translation(const glm::dvec3& t) {
  glm::dmat4 m(1);
  m[3] = glm::dvec4(t, 1);
  return m;
}

inline glm::dmat4 scaling(const glm::dvec3& s) {
  glm::dmat4 m(1);
  for (int i = 0; i < 3; ++i) m[i][i] = s[i];
  return m;
}

/// About an axis in general position.
inline glm::dmat4 rotation(double angle) {
  const glm::dvec3 a = glm::normalize(glm::dvec3(0.3, 0.8, -0.5));
  const double c = std::cos(angle), s = std::sin(angle);
  glm::dmat4 m(1);
  for (int i = 0; i < 3; ++i) {
    glm::dvec3 e(0);
    e[i] = 1;
    m[i] = glm::dvec4(e * c + glm::cross(a, e) * s + a * (a[i] * (1 - c)), 0);
  }
  return m;
}

}  // namespace glint::test
