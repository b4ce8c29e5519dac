#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace glint::models {

/// Triangles as they go into a file: model space, +Y up, counter-clockwise seen from outside.
struct Mesh {
  std::vector<glm::vec3> positions;
  /// Unit length, one a position; empty on the unit sphere, where the positions are the normals.
  std::vector<glm::vec3> normals;
  std::vector<glm::vec2> texcoords;  ///< one a position, or empty; (0, 0) is the upper left
  std::vector<std::uint32_t> indices;
};

/// The unit sphere by longitude and latitude, poles on the Y axis, with texture coordinates: the
/// seam is at -Z, u grows to the right seen from outside, v is 0 at the north pole.
/// `around` is a multiple of 8, `down` one of 4.
Mesh sphere(int around, int down);

/// The torus around the Y axis; the circle of radius `minor` runs at the distance `major`.
/// `around` and `along` (the small circle) are multiples of 8.
Mesh torus(double major, double minor, int around, int along);

/// The unit sphere as an icosahedron, each triangle cut into four `level` times with the new
/// vertices moved onto the sphere: 20 * 4^level triangles. It is turned so that no vertex lies on
/// an axis or in a coordinate plane, where errors of shading could vanish by symmetry.
Mesh icosphere(int level);

/// A tube of radius `thickness` about the trefoil knot that goes twice around the Y axis and three
/// times around the small circle of the torus of these radii. `along` and `around` (the tube) are
/// multiples of 8.
Mesh torusKnot(double major, double minor, double thickness, int along, int around);

/// The Utah teapot, 1.5 high, standing on y = 0, the spout towards +X; each patch is a grid of
/// `steps` by `steps` quadrilaterals. Vertices that patches share are one where the normals agree.
Mesh teapot(int steps);

}  // namespace glint::models
