#include "glint/render/triangle_order.h"

#include <algorithm>

#include "glint/render/face_mesh.h"

namespace glint {

std::vector<std::uint32_t> farthestFirst(const Mesh& mesh, bool faces,
                                         const glm::mat4& eyeFromModel) {
  faces = faces && mesh.topology == Topology::triangles;
  const FaceMesh faceMesh = faces ? makeFaceMesh(mesh) : FaceMesh{};
  const std::vector<std::uint32_t>& indices = faces ? faceMesh.indices : mesh.indices;
  const std::size_t corners = mesh.topology == Topology::triangles ? 3
                              : mesh.topology == Topology::lines   ? 2
                                                                   : 1;
  const glm::vec3 along(eyeFromModel[0].z, eyeFromModel[1].z, eyeFromModel[2].z);
  struct Piece {
    float depth;
    std::uint32_t first;
  };
  std::vector<Piece> pieces;
  pieces.reserve(indices.size() / corners);
  for (std::size_t i = 0; i + corners <= indices.size(); i += corners) {
    float sum = 0;  // of the corners' z; all pieces have as many corners
    for (std::size_t k = 0; k < corners; ++k) {
      const std::uint32_t vertex = indices[i + k];
      const std::uint32_t source =
          faces && !faceMesh.source.empty() ? faceMesh.source[vertex] : vertex;
      sum += glm::dot(along, mesh.positions[source]);
    }
    pieces.push_back({sum, std::uint32_t(i)});
  }
  // The eye looks along -z.
  std::ranges::stable_sort(pieces, {}, &Piece::depth);
  std::vector<std::uint32_t> ordered;
  ordered.reserve(indices.size());
  for (const Piece& piece : pieces)
    ordered.insert(ordered.end(), indices.begin() + piece.first,
                   indices.begin() + piece.first + std::ptrdiff_t(corners));
  return ordered;
}

}  // namespace glint
