#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "glint/scene/scene.h"

namespace glint::gltf {

/// Fills Mesh::tangents from positions, normals and the texture coordinates by which the normal map
/// is looked up, as MikkTSpace does by default (M. Mikkelsen, "Simulation of Wrinkled Surfaces
/// Revisited", 2008, and his reference code): equal vertices are one; of the faces around a vertex
/// those that are joined by edges and have the same handedness share a tangent, the mean of theirs
/// in the plane of the normal, weighted by angle; faces without area in the texture join any group.
/// A vertex in several groups is split. The handedness is glTF's, whose v runs downwards: +1 where
/// the picture is not mirrored.
///
/// `texcoords` has one entry a position. Triangles only.
void makeTangents(Mesh& mesh, const std::vector<glm::vec2>& texcoords);

}  // namespace glint::gltf
