#pragma once

#include <map>
#include <vector>

#include "glint/shading/forms.h"

namespace glint {

/// The cost of the reflectance forms, per pixel.
struct ReflectanceCosts {
  double exact, textbook;
  double schlick;          ///< with exponent 5, a power by squaring
  double schlickExponent;  ///< with other exponents
  double schlickExp2, rational;
  bool operator==(const ReflectanceCosts&) const = default;
};

/// The relative costs of the forms, in hundredths of the exact lobe's: a lobe per pixel and light,
/// a reflectance per pixel. These values ship with the project, so that --max-error makes the same
/// choice on every machine; docs/approximations.md says where they come from and how to measure a
/// table on another driver.
struct CostTable {
  /// The shipped table.
  CostTable();

  /// For each form with its own costs, laid out as HighlightRow::costs.
  std::map<Highlight, std::vector<double>> lobes;

  ReflectanceCosts fresnel{31, 42, 21, 77, 28, 30};
  /// If some side is seen from the denser medium.
  ReflectanceCosts fresnelDenser{67, 44, 78, 167, 101, 77};

  /// The cost of switching to lights with another form: one more loop, too cheap to measure. Above
  /// 0, so that an additional form has to pay for itself.
  static constexpr double change = 1;

  /// The cost of a lobe. `power` is gamma, or the exponent for `integer`.
  double lobe(Highlight form, int power) const;
  double reflectance(Fresnel form, double schlickExponent, bool denserSide) const;
  bool operator==(const CostTable&) const = default;
};

/// The multiplications for a power from 1 to 128 by squaring: one for each bit after the first, and
/// one more for each of those bits that is set.
int productsOf(int power);

}  // namespace glint
