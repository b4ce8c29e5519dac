#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "glint/scene/scene.h"

namespace glint {

/// The indices with which GpuScene draws a mesh (with `faces`, those for the program `flat`),
/// sorted so that its triangles, lines or points come farthest first by the means of their corners.
/// Those that overlap may still be in the wrong order; the caller must check.
std::vector<std::uint32_t> farthestFirst(const Mesh&, bool faces, const glm::mat4& eyeFromModel);

}  // namespace glint
