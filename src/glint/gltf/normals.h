#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

#include "glint/scene/scene.h"

namespace glint::gltf {

/// The vector scaled to length 1; its largest component is scaled to 1 first, so that no square
/// over- or underflows. Zero if it has no direction: all zero, infinite or NaN.
glm::dvec3 direction(const glm::dvec3& vector);

/// Twice the area of a triangle along its normal (counter-clockwise seen from its tip), in double:
/// in float the cross product of a sliver cancels to noise.
glm::dvec3 areaVector(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);

/// Gives each triangle of a mesh its own three vertices, with the face's normal, as the standard
/// requires for meshes without normals. Faces without area get (0, 0, 1): they are invisible.
void makeFlat(Mesh& mesh);

/// Scales each to length 1, or to 0 if it has no direction; returns the number of the latter.
std::size_t normaliseEach(std::vector<glm::vec3>& normals);

/// Normalises the normals of a triangle mesh. Those without direction are replaced by the
/// area-weighted mean of the adjacent faces' normals, or by one face's if that mean cancels.
/// Returns how many were replaced.
std::size_t mendNormals(Mesh& mesh);

/// Whether in some triangle a mean of the three normals may vanish, or nearly so.
bool normalsMayCancel(const Mesh& mesh);

}  // namespace glint::gltf
