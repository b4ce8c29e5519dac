#pragma once

#include <cstddef>
#include <optional>

#include "glint/gltf/document.h"
#include "glint/gltf/pose.h"
#include "glint/scene/scene.h"

namespace glint::gltf {

/// A primitive that is ready to draw.
struct BuiltMesh {
  Mesh mesh;
  bool skinned = false;  ///< the positions are already in world space
};

/// Reads `model.meshes[mesh].primitives[primitive]` in a pose; empty if there is nothing to draw.
/// `materials` are the scene's, the default one last; they determine which texture coordinates are
/// read. Fails on indices out of range and on attributes of the wrong type or too short.
std::optional<BuiltMesh> buildMesh(const Document& document, std::size_t mesh,
                                   std::size_t primitive, const Pose& pose,
                                   const std::vector<Material>& materials, Budget& budget,
                                   Messages& messages);

}  // namespace glint::gltf
