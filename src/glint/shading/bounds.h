#pragma once

#include "glint/shading/environment_map.h"
#include "glint/shading/forms.h"
#include "glint/shading/lobe.h"

namespace glint {

/// Half the distance from 1 to the next float.
namespace rounding {
constexpr double u = 0x1p-24;
}

// How far the forms of lobe and reflectance are from the exact functions, as upper bounds in
// absolute terms. Two kinds, which add up: that of the formula, as if computed without rounding,
// and that of the rounding of a shader in single precision.
//
// The formula's bounds are found at run time from the parameters, not looked up: for the lobes the
// stationary points of the error are known to be few and are bisected, which is exact to rounding;
// for the reflectances every cell of a subdivision of [0, 1] is bounded by monotonicity.

/// The largest |form - exact| of the lobe over lambda in [0, 2]. For alpha in [0, 1e6], gamma a
/// power of two that the form has. 0 for exact, pow and integer, 1 for none.
double lobeFormulaBound(Highlight form, int gamma, double alpha);

/// Of single forms, for alpha > 0.
double lyonBound(double alpha, int gamma);
double lyonTunedBound(double alpha, int gamma);
double lyonCrossBound(double alpha, int gamma);
double padeBound(double alpha, int gamma);
double gaussianBound(double alpha);
double tableBound(double alpha, int steps);

/// The largest |form - exact| of the reflectance over all angles, for either direction through the
/// boundary (which have the same). At most a quarter too large; errors below 1e-9 count as that.
/// `exponent` is Schlick's.
double fresnelFormulaBound(Fresnel form, double n1, double n2, double exponent = 5.0);

// Rounding, with u = 2^-24. Additions and products are correctly rounded, as GLSL has it; division,
// sqrt and exp2 as its table of precision has them (2.5 ulp, from them, 3 + 2 |x| ulp); log2 within
// 2^-21 near 1. The functions of glsl/ are held to these by tests on the driver.

/// How far the exact lobe moves where the difference vector D is off by `turn`, as below.
double lobeTurnBound(double alpha, bool blinn, double turn);

/// What rounding adds to a lobe that a shader computes from rounded unit vectors N, L and V of its
/// own, against the exact lobe of the same geometry in double.
///
/// The difference vector D is off by d <= 6.5e-7, which moves the exact lobe by at most d times the
/// steepest slope of (1 - |D|^2/2)^alpha; for Blinn-Phong d is divided by |L + V| / 2, as the half
/// vector turns by that much more. `blinn` counts with |L + V| >= 1/4: directions less than 165
/// degrees apart. Nearer to opposition the half vector of rounded vectors means less and less,
/// whatever the form. Then the form itself rounds: a power p by squaring by 3/2 p + 4 roundings.
double lobeRoundingBound(Highlight form, int gamma, double alpha, bool blinn);

/// What rounding adds to a reflectance whose cosine c is off by 5 u (1 + c), that of a dot product
/// of rounded unit vectors: the exact R moves most next to grazing incidence, or from criticalRing
/// on next to the critical angle; the formula's own evaluation is off by 1e-6 (the rational form by
/// 1.5e-6; the textbook's by what it cancels).
double fresnelRoundingBound(Fresnel form, double n1, double n2, double exponent = 5.0);

/// The cosines next to the critical one of which fresnelRoundingBound does not speak, as it does
/// not of total reflection that rounds to none: R has infinite slope there, and the rounding of the
/// cosine alone moves it by up to 0.01. 1e-5 on either side, or 1/100 of all beyond the critical
/// cosine; 0 from the thinner side. Of all directions to a back face one in 100,000 lies there.
double criticalRing(double n1, double n2);

/// An upper bound of the radiance of a built-in environment in any channel and direction, and of
/// how fast it changes with the direction (per radian).
double largestRadiance(BuiltinEnvironment environment);
double steepestRadiance(BuiltinEnvironment environment);

}  // namespace glint
