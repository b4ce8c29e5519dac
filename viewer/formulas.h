#pragma once

#include <glm/glm.hpp>
#include <string>

namespace glint::viewer {

// The double-precision formulas of src/shading by the names that a look gives their forms.

/// What the sum reads of a material and a look.
struct SumInput {
  double ambient = 1, diffuse = 1, specular = 0, exponent = 20, blinnFactor = 4;
  bool blinn = false;
  std::string highlight = "exact";  ///< as --highlight has it
};

/// What C and S multiply.
struct SumValue {
  glm::dvec3 matte{0.0}, specular{0.0};
};

/// One light; N, L and V are unit.
SumValue lightValue(const SumInput&, const glm::dvec3& N, const glm::dvec3& L, const glm::dvec3& V,
                    const glm::dvec3& intensity);

/// The lobe for a geometry, by the form named or by "exact".
double lobeValue(const SumInput&, const std::string& form, const glm::dvec3& N, const glm::dvec3& L,
                 const glm::dvec3& V);

/// The reflectance by the form that --fresnel names.
double fresnelValue(const std::string& form, double cosTheta, double n1, double n2,
                    double schlickExponent);

}  // namespace glint::viewer
