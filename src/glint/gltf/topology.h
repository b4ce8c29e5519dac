#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "glint/gltf/accessor.h"
#include "glint/scene/scene.h"

namespace glint::gltf {

/// Points, lines or triangles, as indices into the vertices of a primitive.
struct Elements {
  Topology topology = Topology::triangles;
  std::vector<std::uint32_t> indices;
  /// Indices left over at the end, too few for another line or triangle.
  std::size_t rest = 0;
};

/// Vertices of one element: 1, 2 or 3.
constexpr std::size_t cornersOf(Topology topology) {
  return topology == Topology::points ? 1 : topology == Topology::lines ? 2 : 3;
}

/// Converts a glTF primitive of any mode (0 to 6) to a list, with the winding that section 3.7.2.1
/// of the standard defines for strips and fans. Lines and triangles that use a vertex twice are
/// dropped: they only join strips.
Elements listElements(int mode, std::vector<std::uint32_t> indices);

/// The vertices that `indices` use, in ascending order; `indices` then refer to that list. Every
/// index must be below `vertexCount`. The running time depends on the number of indices, not of
/// vertices: a file may draw a large accessor in many small pieces.
VertexList useVertices(std::vector<std::uint32_t>& indices, std::size_t vertexCount);

/// Keeps only the values of the listed vertices.
template <typename Value>
void select(std::vector<Value>& values, const VertexList& list) {
  if (values.empty() || list.all) return;
  for (std::size_t i = 0; i < list.count; ++i) values[i] = values[list.ids[i]];  // ids ascend
  values.resize(list.count);
}

}  // namespace glint::gltf
