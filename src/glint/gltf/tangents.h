#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "glint/scene/scene.h"

namespace glint::gltf {

/// Fills Mesh::tangents from positions, normals and the normal map's texture coordinates, as
/// MikkTSpace does by default (M. Mikkelsen, "Simulation of Wrinkled Surfaces Revisited", 2008, and
/// his reference code): equal vertices are merged; faces around a vertex that are joined by edges
/// and have the same handedness share a tangent, the angle-weighted mean of their own in the plane
/// of the normal; faces without area in the texture join any group. A vertex in several groups is
/// split. The handedness is glTF's, where v runs downwards: +1 if the picture is not mirrored.
///
/// `texcoords` has one entry per position. Triangles only.
void makeTangents(Mesh& mesh, const std::vector<glm::vec2>& texcoords);

}  // namespace glint::gltf
