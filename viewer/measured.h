#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "glint/scene/scene.h"

namespace glint::viewer {

/// A measured reflectance in the format of the MERL database (Matusik et al. 2003, "A Data-Driven
/// Reflectance Model"): isotropic, over the angles of the half vector and of the light relative to
/// it.
class MeasuredMaterial {
 public:
  /// Reads a `.binary` file; throws InputError if it is not one.
  explicit MeasuredMaterial(const std::filesystem::path&);

  const std::filesystem::path& path() const { return path_; }

  /// The counterpart of the model's sum for a light of intensity 1: pi times the reflectance times
  /// N.L, so that a white diffuse surface gives N.L. Unit vectors, N is (0, 0, 1). NaN below the
  /// horizon and where nothing was measured.
  glm::dvec3 light(const glm::dvec3& L, const glm::dvec3& V) const;

  /// Bins of the half vector's angle (denser near 0), of the angle between it and the light, and of
  /// the light's azimuth about it, over half a turn.
  glm::ivec3 bins() const { return bins_; }

 private:
  std::filesystem::path path_;
  glm::ivec3 bins_{0};
  std::vector<float> values_[3];
};

/// A lobe as in the window: Phong's, or Blinn's with its factor.
struct FitForm {
  bool blinn = false;
  double blinnFactor = 4;
};

/// The model's sum for a light of intensity 1 without ambient light, with the exact form of the
/// lobe.
glm::dvec3 modelLight(const ShadingParameters&, const FitForm&, const glm::dvec3& L,
                      const glm::dvec3& V);

/// The error of a model against a measured material, over pairs of directions that are uniform over
/// both hemispheres, up to 80 degrees from the normal; linear light, all channels.
struct FitError {
  double rmse = 0, largest = 0;
  double relative = 0;  ///< rmse divided by the root mean square of the measurements
};
FitError errorOf(const MeasuredMaterial&, const ShadingParameters&, const FitForm&);

/// Fits colour, diffuse, specular, exponent and metalness with the least rmse; the other parameters
/// are those of `from`.
ShadingParameters fitted(const MeasuredMaterial&, const FitForm&, const ShadingParameters& from);

}  // namespace glint::viewer
