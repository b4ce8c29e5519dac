#pragma once

#include <array>

#include "glint/shading/fresnel.h"
#include "glint/shading/lobe.h"

namespace glint {

/// What a reflectance costs, for each pixel.
struct ReflectanceCosts {
  double exact, textbook;
  double schlick;          ///< with the exponent 5, a power by squaring
  double schlickExponent;  ///< with another
  double schlickExp2, rational;
  bool operator==(const ReflectanceCosts&) const = default;
};

/// What the forms cost beside each other, in hundredths of what the exact lobe costs: a lobe for
/// each pixel and light, a reflectance for each pixel. What stands here ships with the project, so
/// that the choice by --max-error is the same on every machine; docs/approximations.md says where
/// it comes from, and how to measure a table on another driver.
struct CostTable {
  double exact = 100, pow = 68, gaussian = 34;
  /// By the number of multiplications that the power takes, productsOf().
  std::array<double, 13> integer{22, 23, 24, 25, 26, 27, 29, 30, 31, 32, 33, 34, 35};
  /// By the binary logarithm of gamma. lyon-tuned is lyon with another constant.
  std::array<double, 7> lyon{22, 24, 26, 27, 28, 29, 30};
  std::array<double, 7> lyonCross{26, 27, 28, 29, 30, 32, 33};
  std::array<double, 7> pade{29, 30, 31, 32, 33, 35, 38};

  ReflectanceCosts fresnel{31, 42, 21, 77, 28, 30};
  /// Where some side is seen from the denser medium.
  ReflectanceCosts fresnelDenser{67, 44, 78, 167, 101, 77};

  /// Of going on to lights of another form: one more loop, whose cost is too small to be measured.
  /// Above 0, so that a form more has to pay.
  static constexpr double change = 1;

  /// Of a lobe. `power` is gamma, or of `integer` the exponent.
  double lobe(LobeForm form, int power) const;
  double reflectance(FresnelForm form, double schlickExponent, bool denserSide) const;
  bool operator==(const CostTable&) const = default;
};

/// The multiplications of a power from 1 to 128 by squaring: one for each bit after the first and
/// one more for each of those that is set.
int productsOf(int power);

}  // namespace glint
