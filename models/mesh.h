#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace glint::models {

/// Triangles as stored in a file: model space, +Y up, counter-clockwise seen from outside.
struct Mesh {
  std::vector<glm::vec3> positions;
  /// Unit length, one per position; empty for the unit sphere, where the positions are the normals.
  std::vector<glm::vec3> normals;
  std::vector<glm::vec2> texcoords;  ///< one per position, or empty; (0, 0) is the upper left
  std::vector<std::uint32_t> indices;
};

/// The unit sphere by longitude and latitude, poles on the Y axis, with texture coordinates: the
/// seam is at -Z, u grows to the right seen from outside, v is 0 at the north pole.
/// `around` is a multiple of 8, `down` one of 4.
Mesh sphere(int around, int down);

/// The torus around the Y axis: a tube of radius `minor` around a circle of radius `major`.
/// `around` and `along` (around the tube) are multiples of 8.
Mesh torus(double major, double minor, int around, int along);

/// The unit sphere as an icosahedron whose triangles are divided into four `level` times, with the
/// new vertices moved onto the sphere: 20 * 4^level triangles. It is rotated so that no vertex lies
/// on an axis or in a coordinate plane, where shading errors could vanish by symmetry.
Mesh icosphere(int level);

/// A tube of radius `thickness` around the trefoil knot that goes twice around the Y axis and three
/// times around the tube of the torus with these radii. `along` and `around` (the tube) are
/// multiples of 8.
Mesh torusKnot(double major, double minor, double thickness, int along, int around);

/// The Utah teapot, 1.5 high, standing on y = 0, with its spout towards +X; each patch is a grid of
/// `steps` by `steps` quadrilaterals. Patches share vertices where their normals agree.
Mesh teapot(int steps);

}  // namespace glint::models
