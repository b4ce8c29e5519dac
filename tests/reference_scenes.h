#pragma once

#include <glm/glm.hpp>
#include <utility>
#include <vector>

#include "glint/reference/renderer.h"
#include "glint/scene/camera.h"
#include "glint/scene/look.h"
#include "glint/scene/scene.h"

/// Small scenes whose pictures can be computed by hand.
namespace scenes {

using glint::Look;
using glint::Mesh;
using glint::Scene;

/// Triangles, three positions each, with the normal +Z.
inline Mesh triangles(std::vector<glm::vec3> positions) {
  Mesh mesh;
  mesh.positions = std::move(positions);
  mesh.normals.assign(mesh.positions.size(), glm::vec3(0, 0, 1));
  for (std::uint32_t i = 0; i < mesh.positions.size(); ++i) mesh.indices.push_back(i);
  return mesh;
}

/// A rectangle of two triangles; vertices: lower left, lower right, upper right, upper left.
inline Mesh rectangle(glm::vec2 low, glm::vec2 high, float z = 0) {
  Mesh mesh = triangles({{low, z}, {high.x, low.y, z}, {high, z}, {low.x, high.y, z}});
  mesh.indices = {0, 1, 2, 0, 2, 3};
  return mesh;
}

/// One mesh per material, at the origin, in this order.
inline Scene sceneOf(std::vector<std::pair<Mesh, glint::Material>> parts) {
  Scene scene;
  scene.name = "test";
  for (auto& [mesh, material] : parts) {
    mesh.material = int(scene.materials.size());
    scene.materials.push_back(material);
    scene.instances.push_back({int(scene.meshes.size()), glm::dmat4(1.0)});
    scene.meshes.push_back(std::move(mesh));
  }
  scene.materials.emplace_back();
  return scene;
}

/// An orthographic camera on +Z at the distance z that sees 2 halfHeight of the plane z = 0. With
/// powers of two for all, window coordinates have no rounding.
inline void lookAlongZ(Scene& scene, Look& look, double halfHeight, double z = 8) {
  glint::FileCamera camera;
  camera.orthographic = true;
  camera.halfHeight = halfHeight;
  camera.world[3] = glm::dvec4(0, 0, z, 1);
  scene.cameras = {camera};
  look.cameraIndex = 0;
}

/// A camera at the origin that looks along -Z; `halfHeight` is the picture's half height at
/// distance 1.
inline void lookFromOrigin(Scene& scene, Look& look, double halfHeight, double near, double far) {
  glint::FileCamera camera;
  camera.viewAngle = 2 * std::atan(halfHeight);
  scene.cameras = {camera};
  look.cameraIndex = 0;
  look.clippingRange = glm::dvec2(near, far);
}

inline Look plainLook(int width, int height, glint::Shading shading = glint::Shading::phong) {
  Look look;
  look.shading = shading;
  look.resolution = {width, height};
  look.antiAliasing.mode = glint::AntiAliasing::Mode::none;
  return look;
}

inline glint::ReferenceRenderer referenceOf(const Scene& scene, const Look& look,
                                            const glint::DecodedImages& images = {},
                                            int threads = 1) {
  return {scene, images, glint::boundsOf(scene), look, threads};
}

inline glint::Image draw(const Scene& scene, const Look& look,
                         const glint::DecodedImages& images = {}, int threads = 1) {
  glint::ReferenceRenderer renderer(scene, images, glint::boundsOf(scene), look, threads);
  return renderer.draw();
}

inline glm::dvec4 pixel(const glint::Image& image, int x, int y) {
  const float* p = image.row(y) + std::size_t(4) * std::size_t(x);
  return {p[0], p[1], p[2], p[3]};
}

}  // namespace scenes
