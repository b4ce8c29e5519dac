#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "glint/scene/look.h"
#include "glint/shading/costs.h"

namespace glint {

/// The light that the lights of a picture can bring to one point, in the order of shiningLights().
struct LightReach {
  /// For each light, its largest intensity anywhere on the scene, linear.
  std::vector<glm::dvec3> most;
  /// The largest sum of them at one point.
  glm::dvec3 together{0.0};
  /// A bound of the sum, at one point, of the lights in [from, end).
  glm::dvec3 of(std::size_t from, std::size_t end) const;
};

/// What the forms' bounds need to know about surfaces that share forms.
struct FormNeeds {
  bool specular = false, dielectric = false;
  std::vector<double> exponents;  ///< of the lobe as drawn; all that occur
  bool varyingExponent = false;   ///< some exponent varies from pixel to pixel
  glm::dvec3 shine{0.0};          ///< m_s S
  struct Mirror {
    double radiance = 0;  ///< multiplies an error of the reflectance
    double ior = 1;
    bool back = false;  ///< seen from inside, too
    bool operator==(const Mirror&) const = default;
  };
  std::vector<Mirror> mirrors;
  bool denserSide = false;  ///< some mirror shows its side in the denser medium
  double rest = 0;          ///< the part of the bound that does not depend on the forms
};

/// Forms, their errors against the exact ones in linear radiance, and their cost
/// (glint/shading/costs.h).
struct ChosenForms {
  HighlightForms highlight;
  Fresnel fresnel = Fresnel::exact;
  double lobe = 0, reflectance = 0;  ///< errors of the formulas
  double rounding = 0;               ///< of lobes and reflectance
  double cost = 0, exactCost = 0;
  bool within = false;  ///< within the budget; otherwise they are the exact ones
  double error() const { return lobe + reflectance + rounding; }
};

/// The cheapest forms whose errors, with needs.rest, are within `budget`: one for the reflectance,
/// and up to three for the lobe, the less exact ones for the dimmer lights. Forms that cost as much
/// as exact do not replace it.
ChosenForms cheapestForms(const FormNeeds& needs, const LightReach& lights, const Look& look,
                          const CostTable& costs, bool blinn, double budget);

}  // namespace glint
