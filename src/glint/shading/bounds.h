#pragma once

#include "glint/shading/environment_map.h"
#include "glint/shading/forms.h"
#include "glint/shading/lobe.h"

namespace glint {

/// Half the distance from 1 to the next float.
namespace rounding {
constexpr double u = 0x1p-24;
}

// Upper bounds on the absolute error of the forms of lobe and reflectance compared with the exact
// functions. There are two kinds, which add up: the error of the formula, as if computed without
// rounding, and the rounding error of a shader in single precision.
//
// Formula bounds are computed at run time from the parameters, not looked up: for the lobes the
// stationary points of the error are known to be few and are found by bisection, which is exact to
// rounding; for the reflectances every cell of a subdivision of [0, 1] is bounded by monotonicity.

/// The largest |form - exact| of the lobe over lambda in [0, 2], for alpha in [0, 1e6] and gamma a
/// power of two that the form supports. 0 for exact, pow and integer, 1 for none.
double lobeFormulaBound(Highlight form, int gamma, double alpha);

/// The same for single forms, for alpha > 0.
double lyonBound(double alpha, int gamma);
double lyonTunedBound(double alpha, int gamma);
double lyonCrossBound(double alpha, int gamma);
double padeBound(double alpha, int gamma);
double gaussianBound(double alpha);
double tableBound(double alpha, int steps);

/// The largest |form - exact| of the reflectance over all angles, for either direction through the
/// boundary (both have the same). At most a quarter too large; errors below 1e-9 count as 1e-9.
/// `exponent` is Schlick's.
double fresnelFormulaBound(Fresnel form, double n1, double n2, double exponent = 5.0);

// Rounding, with u = 2^-24. Additions and products are correctly rounded, as GLSL requires;
// division, sqrt and exp2 are as in its precision table (2.5 ulp, inherited, 3 + 2 |x| ulp);
// log2 is within 2^-21 near 1. Tests on the driver hold the functions of glsl/ to these.

/// How much the exact lobe changes if the difference vector D is off by `turn`, as below.
double lobeTurnBound(double alpha, bool blinn, double turn);

/// The error that rounding adds to a lobe that a shader computes from its own rounded unit vectors
/// N, L and V, compared with the exact lobe of the same geometry in double.
///
/// The difference vector D is off by d <= 6.5e-7, which changes the exact lobe by at most d times
/// the steepest slope of (1 - |D|^2/2)^alpha; for Blinn-Phong d is divided by |L + V| / 2, as the
/// half vector turns by that much more. `blinn` assumes |L + V| >= 1/4: directions less than 165
/// degrees apart. Closer to opposition the half vector of rounded vectors loses its meaning,
/// whatever the form. The form's own rounding is added: 3/2 p + 4 roundings for a power p by
/// squaring.
double lobeRoundingBound(Highlight form, int gamma, double alpha, bool blinn);

/// The error that rounding adds to a reflectance whose cosine c is off by 5 u (1 + c), the error of
/// a dot product of rounded unit vectors. The exact R changes most next to grazing incidence or,
/// outside criticalRing, next to the critical angle. Evaluating the formula adds 1e-6 (the rational
/// form 1.5e-6; the textbook's form what it cancels).
double fresnelRoundingBound(Fresnel form, double n1, double n2, double exponent = 5.0);

/// The width of the range next to the critical cosine that fresnelRoundingBound does not cover; nor
/// does it cover total reflection that rounding makes partial. R has infinite slope there, and
/// rounding the cosine alone changes it by up to 0.01. It is 1e-5 on either side, or 1/100 of the
/// range above the critical cosine if that is less; 0 from the thinner side. One in 100,000 of all
/// directions to a back face lies there.
double criticalRing(double n1, double n2);

/// Upper bounds on the radiance of a built-in environment in any channel and direction, and on its
/// rate of change with direction (per radian).
double largestRadiance(BuiltinEnvironment environment);
double steepestRadiance(BuiltinEnvironment environment);

}  // namespace glint
