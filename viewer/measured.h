#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "glint/scene/scene.h"

namespace glint::viewer {

/// A measured reflectance in the format of the MERL database (Matusik et al. 2003, "A Data-Driven
/// Reflectance Model"): isotropic, over the angles of the half vector and of the light from it.
class MeasuredMaterial {
 public:
  /// Reads a `.binary` file; throws InputError where it is not one.
  explicit MeasuredMaterial(const std::filesystem::path&);

  const std::filesystem::path& path() const { return path_; }

  /// What the sum of a light of intensity 1 stands for here: pi times the reflectance times N.L, so
  /// that a white diffuse surface gives N.L. Unit vectors, N is (0, 0, 1). Below the horizon, and
  /// where nothing was measured, NaN.
  glm::dvec3 light(const glm::dvec3& L, const glm::dvec3& V) const;

  /// Bins of the half vector's angle (closer near 0), of the angle between it and the light, and of
  /// the light's way about it, over half a turn.
  glm::ivec3 bins() const { return bins_; }

 private:
  std::filesystem::path path_;
  glm::ivec3 bins_{0};
  std::vector<float> values_[3];
};

/// A lobe in the window's terms: Phong's, or Blinn's with its factor.
struct FitForm {
  bool blinn = false;
  double blinnFactor = 4;
};

/// The sum of a light of intensity 1 without ambient light, in the exact form of the lobe.
glm::dvec3 modelLight(const ShadingParameters&, const FitForm&, const glm::dvec3& L,
                      const glm::dvec3& V);

/// How far a model is from a measured material, over pairs of directions that are uniform over both
/// hemispheres, to 80 degrees from the normal; linear light, all channels.
struct FitError {
  double rmse = 0, largest = 0;
  double relative = 0;  ///< rmse over the root mean square of what was measured
};
FitError errorOf(const MeasuredMaterial&, const ShadingParameters&, const FitForm&);

/// The colour, diffuse, specular, exponent and metalness that come nearest by the rmse; the other
/// parameters are those of `from`.
ShadingParameters fitted(const MeasuredMaterial&, const FitForm&, const ShadingParameters& from);

}  // namespace glint::viewer
