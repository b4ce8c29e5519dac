#include "glint/gltf/pose.h"

#include <algorithm>
#include <cmath>

#include "glint/gltf/normals.h"

namespace glint::gltf {
namespace {

struct Blend {
  glm::dmat4 matrix{0.0};
  bool badWeights = false;
  bool badJoint = false;
};

Blend blend(const Bindings& bindings, const std::vector<glm::dmat4>& joints, std::size_t vertex) {
  Blend result;
  double sum = 0;
  for (std::size_t set = 0; set < bindings.joints.size(); ++set) {
    for (int k = 0; k < 4; ++k) {
      const double weight = bindings.weights[set][vertex][k];
      if (weight == 0) continue;
      if (!(weight > 0) || !std::isfinite(weight)) {
        result.badWeights = true;
        continue;
      }
      const double joint = bindings.joints[set][vertex][k];
      if (!(joint >= 0 && joint < static_cast<double>(joints.size()))) {
        result.badJoint = true;
        return result;
      }
      result.matrix += weight * joints[static_cast<std::size_t>(joint)];
      sum += weight;
    }
  }
  if (sum > 0) {
    result.matrix /= sum;
  } else {
    result.badWeights = true;
    const double joint = bindings.joints[0][vertex][0];
    const bool exists = joint >= 0 && joint < static_cast<double>(joints.size());
    result.matrix = joints[exists ? static_cast<std::size_t>(joint) : 0];
  }
  return result;
}

/// The determinant times the inverse transpose, which is defined for singular matrices too.
glm::dmat3 cofactors(const glm::dmat3& m) {
  return {glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1])};
}

}  // namespace

bool Pose::morphs() const {
  return std::ranges::any_of(weights, [](double weight) { return weight != 0; });
}

SkinResult skin(const Bindings& bindings, const std::vector<glm::dmat4>& joints,
                std::vector<glm::dvec3>& positions, std::vector<glm::dvec3>& normals) {
  SkinResult result;
  std::size_t mirrored = 0;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const Blend mean = blend(bindings, joints, i);
    if (mean.badJoint) {
      result.badJoint = true;
      return result;
    }
    if (mean.badWeights) ++result.badWeights;
    positions[i] = glm::dvec3(mean.matrix * glm::dvec4(positions[i], 1));
    const glm::dmat3 turn(mean.matrix);
    const glm::dmat3 turned = cofactors(turn);
    const bool flips = glm::dot(turn[0], turned[0]) < 0;  // the determinant
    if (flips) ++mirrored;
    if (!normals.empty())
      normals[i] = (flips ? -1.0 : 1.0) * direction(turned * direction(normals[i]));
  }
  result.mirrored = mirrored * 2 > positions.size();
  return result;
}

}  // namespace glint::gltf
