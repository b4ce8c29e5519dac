#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "glint/scene/scene.h"

namespace glint {

/// The indices with which GpuScene draws a mesh (with `faces` those for the program `flat`), its
/// triangles, lines or points farthest first by the middles of their corners. What overlaps may
/// still stand in the wrong order: that is for the caller to find out.
std::vector<std::uint32_t> farthestFirst(const Mesh&, bool faces, const glm::mat4& eyeFromModel);

}  // namespace glint
