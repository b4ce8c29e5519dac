#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

namespace glint::gltf {

/// The shape of a mesh: morph weights and the matrices of a skin's joints.
struct Pose {
  std::vector<double> weights;     ///< one per morph target, or fewer: the rest are 0
  std::vector<glm::dmat4> joints;  ///< joint's world times inverse bind matrix; empty if no skin

  bool morphs() const;  ///< whether any weight is not 0
};

/// The joints and weights of vertices: sets of four, as in JOINTS_n and WEIGHTS_n.
struct Bindings {
  std::vector<std::vector<glm::dvec4>> joints;
  std::vector<std::vector<glm::dvec4>> weights;
};

/// Findings from skinning.
struct SkinResult {
  std::size_t badWeights = 0;  ///< vertices with weights that sum to 0 or are negative or NaN
  bool badJoint = false;       ///< a joint with a weight does not exist; nothing was changed
  bool mirrored = false;       ///< most vertices changed their handedness: flip the winding
};

/// Transforms vertices by the weighted mean of their joints' matrices, with weights scaled to sum
/// 1, and normals (may be empty) by the cofactors of that mean, keeping them on the same side of
/// the surface under mirroring. A vertex without a usable weight follows only its first joint.
SkinResult skin(const Bindings& bindings, const std::vector<glm::dmat4>& joints,
                std::vector<glm::dvec3>& positions, std::vector<glm::dvec3>& normals);

}  // namespace glint::gltf
