#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "glint/scene/scene.h"

namespace glint {

/// Triangles that follow each other in a mesh, with what tells of all of them at once that they
/// cannot be seen. Model space.
struct TriangleRun {
  std::uint32_t first = 0, count = 0;  ///< of the mesh's indices
  glm::vec3 low{0}, high{0};           ///< the box around them
  /// A cone that holds the normals of their faces: unit, and the sine of half its angle; above 1
  /// where there is none.
  glm::vec3 axis{0};
  float sine = 2;
};

/// The runs of a mesh of triangles, in its order.
std::vector<TriangleRun> makeTriangleRuns(const Mesh& mesh);

/// Where a mesh is looked at from.
struct RunView {
  /// `projection` may be that of a part of a picture, of so many pixels.
  RunView(const glm::mat4& projection, const glm::mat4& eyeFromModel, glm::ivec2 pixels,
          bool cullsBackFaces);

  /// False if no sample can be covered by the run: it lies beside the picture, by four pixels and
  /// more, or turns its back, by a degree and more, and backs are culled. The margins hold what
  /// float and the grid that drivers snap vertices to may move.
  bool mayShow(const TriangleRun& run) const;

 private:
  glm::dvec4 sides_[4];  ///< planes of the picture's sides; positive within
  /// The eye, or in a parallel projection the way to it (w = 0); model space. All 0: unknown.
  glm::dvec4 eye_{0};
};

/// Appends the stretches of indices, first and count, that hold all runs that may show.
void appendShown(const std::vector<TriangleRun>& runs, const RunView& view,
                 std::vector<std::uint32_t>& firsts, std::vector<std::int32_t>& counts);

}  // namespace glint
