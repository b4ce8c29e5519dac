#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "glint/scene/scene.h"

namespace glint {

/// Consecutive triangles of a mesh, with bounds that show when none of them can be seen. Model
/// space.
struct TriangleRun {
  std::uint32_t first = 0, count = 0;  ///< of the mesh's indices
  glm::vec3 low{0}, high{0};           ///< the box around them
  /// A cone that holds the normals of their faces: its unit axis and the sine of half its angle,
  /// above 1 if there is no such cone.
  glm::vec3 axis{0};
  float sine = 2;
};

/// The runs of a mesh of triangles, in its order.
std::vector<TriangleRun> makeTriangleRuns(const Mesh& mesh);

/// The view of a mesh.
struct RunView {
  /// `projection` may be that of a part of a picture; `pixels` is that part's size.
  RunView(const glm::mat4& projection, const glm::mat4& eyeFromModel, glm::ivec2 pixels,
          bool cullsBackFaces);

  /// False if the run cannot cover any sample: it lies outside the picture by four pixels or more,
  /// or faces away by a degree or more and back faces are culled. The margins allow for float
  /// rounding and for the grid that drivers snap vertices to.
  bool mayShow(const TriangleRun& run) const;

 private:
  glm::dvec4 sides_[4];  ///< planes of the picture's sides; positive within
  /// The eye, or in a parallel projection the direction to it (w = 0); model space. All 0: unknown.
  glm::dvec4 eye_{0};
};

/// Appends the index ranges, first and count, that hold all runs that may show.
void appendShown(const std::vector<TriangleRun>& runs, const RunView& view,
                 std::vector<std::uint32_t>& firsts, std::vector<std::int32_t>& counts);

}  // namespace glint
