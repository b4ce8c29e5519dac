#include "glint/budget/shaded_triangles.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "glint/shading/safe.h"

namespace glint {
namespace {

// The transform of normals: the cofactors, without the sign of a mirror.
glm::dmat3 normalTransform(const glm::dmat3& m) {
  double size = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) size = std::max(size, std::abs(m[i][j]));
  if (!(size > 0)) return glm::dmat3(1.0);
  const glm::dmat3 n = m * (1 / size);
  const glm::dmat3 c(glm::cross(n[1], n[2]), glm::cross(n[2], n[0]), glm::cross(n[0], n[1]));
  return glm::dot(n[0], c[0]) < 0 ? -1.0 * c : c;
}

// Whether a triangle shows only its back, and so nothing: the eye is more than a degree behind its
// plane, which rounding cannot undo.
bool isTurnedAway(const PlacedMesh& p, const ShadedTriangles& set, const Triangle& triangle,
                  bool mirrored) {
  const auto& [a, b, c] = triangle.corners;
  const glm::dvec3 across =
      glm::cross(set.points[b] - set.points[a], set.points[c] - set.points[a]);
  const glm::dvec3 toEye = p.camera.orthographic ? p.camera.axes[2] : -set.points[a];
  const double facing = (mirrored ? -1 : 1) * glm::dot(across, toEye);
  return facing < -0.02 * glm::length(across) * glm::length(toEye);
}

}  // namespace

ShadedTriangles shadedTriangles(const PlacedMesh& p, Shading program) {
  ShadedTriangles set;
  const Mesh& mesh = p.mesh;
  const glm::dmat3 linear(p.world), toNormals = normalTransform(linear);
  for (const glm::vec3& n : mesh.normals)
    set.normals.push_back(safeNormalize(toNormals * glm::dvec3(n)));
  for (const glm::vec3& x : mesh.positions)
    set.points.push_back(linear * (glm::dvec3(x) + mesh.origin) + glm::dvec3(p.world[3]) -
                         p.camera.eye);
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
    set.triangles.push_back({{mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]}});
  const bool mirrored = glm::determinant(linear) < 0;
  if (!p.variant.twoSided)
    std::erase_if(set.triangles, [&](const Triangle& triangle) {
      return isTurnedAway(p, set, triangle, mirrored);
    });
  if (program == Shading::flat) {
    ShadedTriangles faces;
    for (const Triangle& triangle : set.triangles) {
      const auto& [a, b, c] = triangle.corners;
      const glm::dvec3 across =
          glm::cross(set.points[b] - set.points[a], set.points[c] - set.points[a]);
      const bool nothing = mesh.positions[a] == mesh.positions[b] ||
                           mesh.positions[b] == mesh.positions[c] ||
                           mesh.positions[c] == mesh.positions[a];
      if (nothing) continue;
      const glm::dvec3 normal = (mirrored ? -1.0 : 1.0) * safeNormalize(across);
      Triangle own;
      for (int j = 0; j < 3; ++j) {
        const std::uint32_t k = triangle.corners[std::size_t(j)];
        own.corners[std::size_t(j)] = std::uint32_t(faces.points.size());
        faces.points.push_back(set.points[k]);
        faces.normals.push_back(normal);
        faces.offFace = std::max(faces.offFace, glm::length(set.normals[k] - normal));
      }
      if (faces.offFace > flatLimit) return faces;
      faces.triangles.push_back(own);
    }
    set = std::move(faces);
  }
  for (Triangle& triangle : set.triangles) {
    double near = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < 3; ++j) {
      const std::uint32_t a = triangle.corners[j], b = triangle.corners[(j + 1) % 3];
      triangle.chord = std::max(triangle.chord, glm::length(set.normals[a] - set.normals[b]));
      triangle.edge = std::max(triangle.edge, glm::length(set.points[a] - set.points[b]));
      near = std::min(near, glm::length(set.points[a]));
      if (set.normals[a] == glm::dvec3(0.0)) triangle.known = false;
    }
    // 2. of interpolation_bound.h needs corner normals close to each other.
    if (!(triangle.chord <= 1)) triangle.known = false;
    if (!triangle.known) continue;
    const double length = std::sqrt(1 - triangle.chord * triangle.chord / 3);
    triangle.shorter = 1 - length;
    triangle.turn = triangle.chord / length;
    triangle.bent = 1.58 * triangle.turn * triangle.turn * triangle.turn;
    if (p.variant.constantView) continue;
    const double least2 = near * near - triangle.edge * triangle.edge / 3;
    if (least2 > 0)
      triangle.view = triangle.edge / std::sqrt(least2);
    else
      triangle.known = false;
  }
  return set;
}

}  // namespace glint
