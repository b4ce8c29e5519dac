#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "glint/scene/scene.h"

namespace glint {

/// The distance from a place in world space to a scene's nearest triangle, line or point. Boxes
/// around runs of triangles rule most of them out, so that many lamps and many triangles cost
/// little.
class SceneDistance {
 public:
  explicit SceneDistance(const Scene& scene);

  /// Infinite for an empty scene.
  double to(const glm::dvec3& point) const;

 private:
  using Triangle = std::array<glm::dvec3, 3>;
  struct Run {
    std::size_t first, end;
    glm::dvec3 low, high;
  };
  std::vector<Triangle> triangles_;
  std::vector<Run> runs_;
};

}  // namespace glint
