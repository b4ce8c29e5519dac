#pragma once

#include <array>

#include "glint/shading/fresnel.h"
#include "glint/shading/lobe.h"

namespace glint {

/// What the forms cost beside each other, in hundredths of what the exact lobe costs: a lobe for
/// each pixel and light, a reflectance for each pixel. What stands here ships with the project, so
/// that the choice by --max-error is the same on every machine; docs/approximations.md says where
/// it comes from, and how to measure a table on another driver.
struct CostTable {
  double exact = 100, pow = 56, gaussian = 54;
  /// By the number of multiplications that the power takes, productsOf().
  std::array<double, 13> integer{43, 44, 45, 46, 47, 48, 49, 50, 51, 52, 53, 54, 55};
  /// By the binary logarithm of gamma. lyon-tuned is lyon with another constant.
  std::array<double, 7> lyon{45, 46, 47, 48, 49, 50, 51};
  std::array<double, 7> lyonCross{47, 48, 49, 50, 51, 52, 53};
  std::array<double, 7> pade{51, 52, 53, 54, 55, 56, 57};

  double fresnelExact = 100, textbook = 110, schlickExp2 = 45, rational = 40;
  double schlick = 30;          ///< with the exponent 5, a power by squaring
  double schlickExponent = 60;  ///< with another

  /// Of going on to lights of another form: one more loop, whose cost is too small to be measured.
  /// Above 0, so that a form more has to pay.
  static constexpr double change = 1;

  /// Of a lobe. `power` is gamma, or of `integer` the exponent.
  double lobe(LobeForm form, int power) const;
  double reflectance(FresnelForm form, double schlickExponent) const;
  bool operator==(const CostTable&) const = default;
};

/// The multiplications of a power from 1 to 128 by squaring: one for each bit after the first and
/// one more for each of those that is set.
int productsOf(int power);

}  // namespace glint
