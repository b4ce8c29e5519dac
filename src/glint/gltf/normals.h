#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

#include "glint/scene/scene.h"

namespace glint::gltf {

/// The vector scaled to length 1, its largest component brought to 1 first, so that no square
/// over- or underflows. Zero where it has no direction: all zero, infinite or NaN.
glm::dvec3 direction(const glm::dvec3& vector);

/// Twice the area of a triangle along its normal (counter-clockwise seen from its tip), in double:
/// in float the cross product of a sliver cancels to noise.
glm::dvec3 areaVector(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);

/// Gives each triangle of a mesh its own three vertices, with the face's normal, as the standard
/// says for meshes without normals. Faces without area get (0, 0, 1): nothing of them is seen.
void makeFlat(Mesh& mesh);

/// Brings each to length 1, those without direction to 0; gives how many these are.
std::size_t normaliseEach(std::vector<glm::vec3>& normals);

/// Normalises the normals of a triangle mesh. Those without direction become the mean of the
/// adjacent faces' normals weighted by area, or a face's where that mean cancels. Returns how many
/// had to be replaced.
std::size_t mendNormals(Mesh& mesh);

/// Whether a mean of the three normals of some triangle may vanish, or nearly so.
bool normalsMayCancel(const Mesh& mesh);

}  // namespace glint::gltf
