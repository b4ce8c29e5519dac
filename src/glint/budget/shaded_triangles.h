#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "glint/budget/interpolation_bound.h"

namespace glint {

/// A triangle of corners that stand in arrays, and how far normal and view turn over it.
struct Triangle {
  std::array<std::uint32_t, 3> corners{};
  double edge = 0, chord = 0;
  double shorter = 0;  ///< 1 - |n| at most
  double turn = 0, bent = 0;
  double view = 0;
  bool known = true;  ///< otherwise only that everything lies between nothing and all
};

/// The triangles of a mesh that may show, as a program shades them.
struct ShadedTriangles {
  std::vector<glm::dvec3> points, normals;  ///< world, points from the eye
  std::vector<Triangle> triangles;
  double offFace = 0;  ///< flat: how far the normals of a face are from its own
};

/// How far the normals of a face may be from its own, by rounding, to be meant as it.
inline constexpr double flatLimit = 1e-6;

/// The corners are those of the mesh, or for `flat` each face's own. Where `offFace` is above
/// `flatLimit` the list is not whole.
ShadedTriangles shadedTriangles(const PlacedMesh&, Shading program);

}  // namespace glint
