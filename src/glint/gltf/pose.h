#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

namespace glint::gltf {

/// The shape in which a mesh stands: morph weights and the matrices of a skin's joints.
struct Pose {
  std::vector<double> weights;     ///< one a morph target, or fewer: the rest are 0
  std::vector<glm::dmat4> joints;  ///< joint's world times inverse bind matrix; empty without skin

  bool morphs() const;  ///< is any weight not 0?
};

/// The joints and weights of vertices: sets of four, as in JOINTS_n and WEIGHTS_n.
struct Bindings {
  std::vector<std::vector<glm::dvec4>> joints;
  std::vector<std::vector<glm::dvec4>> weights;
};

/// What skinning found.
struct SkinResult {
  std::size_t badWeights = 0;  ///< vertices with weights that sum to 0, negative or NaN ones
  bool badJoint = false;       ///< a joint with a weight does not exist; nothing was changed
  bool mirrored = false;       ///< most vertices changed their handedness: flip the winding
};

/// Moves vertices by the weighted mean of their joints' matrices, weights scaled to sum 1, and
/// turns normals (may be empty) by the cofactors of that mean, pointing to the same side of the
/// surface under mirroring. A vertex without a usable weight follows its first joint alone.
SkinResult skin(const Bindings& bindings, const std::vector<glm::dmat4>& joints,
                std::vector<glm::dvec3>& positions, std::vector<glm::dvec3>& normals);

}  // namespace glint::gltf
