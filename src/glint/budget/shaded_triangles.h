#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "glint/budget/interpolation_bound.h"

namespace glint {

/// A triangle, its corners as indices, and how far normal and view turn over it.
struct Triangle {
  std::array<std::uint32_t, 3> corners{};
  double edge = 0, chord = 0;
  double shorter = 0;  ///< the most that 1 - |n| is
  double turn = 0, bent = 0;
  double view = 0;
  bool known = true;  ///< otherwise the error may be all of the light
};

/// The triangles of a mesh that may show, as a program shades them.
struct ShadedTriangles {
  std::vector<glm::dvec3> points, normals;  ///< world axes; points relative to the eye
  std::vector<Triangle> triangles;
  double offFace = 0;  ///< flat: how far vertex normals are from their face's
};

/// The largest `offFace` that counts as rounding.
inline constexpr double flatLimit = 1e-6;

/// The corners are those of the mesh, or for `flat` each face's own. If `offFace` is above
/// `flatLimit`, the list is incomplete.
ShadedTriangles shadedTriangles(const PlacedMesh&, Shading program);

}  // namespace glint
