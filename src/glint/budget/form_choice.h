#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "glint/scene/look.h"
#include "glint/shading/costs.h"

namespace glint {

/// What the lights of a picture can bring to one point, in the order of shiningLights().
struct LightReach {
  /// Of each the largest intensity that it has anywhere on the scene, linear.
  std::vector<glm::dvec3> most;
  /// The largest sum of them at one point.
  glm::dvec3 together{0.0};
  /// A bound of the sum of those from `from` to before `end` at one point.
  glm::dvec3 of(std::size_t from, std::size_t end) const;
};

/// What the forms' bounds read of the surfaces that are to share forms.
struct FormNeeds {
  bool specular = false, dielectric = false;
  std::vector<double> exponents;  ///< of the lobe as drawn; those that occur
  bool varyingExponent = false;   ///< of some of them, from pixel to pixel
  glm::dvec3 shine{0.0};          ///< m_s S
  struct Mirror {
    double radiance = 0;  ///< that an error of the reflectance is multiplied by
    double ior = 1;
    bool back = false;  ///< seen from within, too
    bool operator==(const Mirror&) const = default;
  };
  std::vector<Mirror> mirrors;
  bool denserSide = false;  ///< some of them shows a side in the denser medium
  double rest = 0;          ///< all of the bound that the choice of forms does not change
};

/// Forms, how far they are from the exact ones in linear radiance, and what they cost
/// (glint/shading/costs.h).
struct ChosenForms {
  HighlightForms highlight;
  Fresnel fresnel = Fresnel::exact;
  double lobe = 0, reflectance = 0;  ///< errors of the formulas
  double rounding = 0;               ///< of lobes and reflectance
  double cost = 0, exactCost = 0;
  bool within = false;  ///< the budget; otherwise they are the exact ones
  double error() const { return lobe + reflectance + rounding; }
};

/// The forms of the least cost whose errors and needs.rest are within `budget`: a reflectance, and
/// lobes of up to three forms, the less exact ones for the dimmer lights. What costs as much as
/// exact does not replace it.
ChosenForms cheapestForms(const FormNeeds& needs, const LightReach& lights, const Look& look,
                          const CostTable& costs, bool blinn, double budget);

}  // namespace glint
