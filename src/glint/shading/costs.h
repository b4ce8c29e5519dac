#pragma once

#include <map>
#include <vector>

#include "glint/shading/forms.h"

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
  /// The shipped one.
  CostTable();

  /// Of each form that has its own, as HighlightRow::costs has them.
  std::map<Highlight, std::vector<double>> lobes;

  ReflectanceCosts fresnel{31, 42, 21, 77, 28, 30};
  /// Where some side is seen from the denser medium.
  ReflectanceCosts fresnelDenser{67, 44, 78, 167, 101, 77};

  /// Of going on to lights of another form: one more loop, whose cost is too small to be measured.
  /// Above 0, so that a form more has to pay.
  static constexpr double change = 1;

  /// Of a lobe. `power` is gamma, or of `integer` the exponent.
  double lobe(Highlight form, int power) const;
  double reflectance(Fresnel form, double schlickExponent, bool denserSide) const;
  bool operator==(const CostTable&) const = default;
};

/// The multiplications of a power from 1 to 128 by squaring: one for each bit after the first and
/// one more for each of those that is set.
int productsOf(int power);

}  // namespace glint
