#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "glint/scene/scene.h"

namespace glint {

/// A triangle mesh in which the last vertex of each triangle belongs only to that triangle, to
/// carry what is constant over its face (GL's provoking vertex). About as many vertices as
/// triangles, not three times as many.
struct FaceMesh {
  std::vector<std::uint32_t> source;  ///< for each vertex, the mesh's vertex that it copies
  std::vector<std::uint32_t> indices;
  /// For each vertex; meaningful for provoking ones. The face's unit normal by its winding (a
  /// vertex's where the face has no area), and its centroid relative to the mesh's origin.
  std::vector<glm::vec3> normals, centers;
};

FaceMesh makeFaceMesh(const Mesh&);

}  // namespace glint
