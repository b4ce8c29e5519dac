#pragma once

#include <glm/glm.hpp>
#include <limits>

namespace glint {

// The specular lobe max(x, 0)^alpha, x being the cosine between R and V (Phong) or N and H
// (Blinn-Phong).
//
// Every form takes lambda = 1 - x as half the squared length of a difference vector (Lyon 1993),
// never as 1 - dot: the dot product of nearly equal unit vectors has lost the digits that a large
// exponent needs. The rounding error of the lobe then grows like sqrt(alpha) 2^-53, not like alpha.
//
// Throughout: lambda is in [0, 2] and clamped to it; `noLobe` and NaN give 0. alpha >= 0; negative
// values and NaN count as 0, for which every form is 1 where x > 0 and 0 elsewhere. The value is in
// [0, 1] for every input.

/// The lambda of a geometry without any highlight.
inline constexpr double noLobe = std::numeric_limits<double>::infinity();

/// If |L + V|^2 is at most this, the half vector is noise in single precision and counts as
/// undefined.
inline constexpr double opposedLimit = 1e-12;

/// |D|^2 / 2 with D = L + V - 2 (N.L) N = V - R; equals 1 - R.V for unit vectors.
double phongLambda(const glm::dvec3& N, const glm::dvec3& L, const glm::dvec3& V);

/// |N - H|^2 / 2 with H = (L + V) / |L + V|; equals 1 - N.H. noLobe if L = -V.
double blinnLambda(const glm::dvec3& N, const glm::dvec3& L, const glm::dvec3& V);

/// max(1 - lambda, 0)^alpha as exp(alpha log1p(-lambda)): error at most 4 * 2^-53 for this lambda.
double lobeExact(double lambda, double alpha);

/// The textbook's max(dot, 0)^alpha from the cosine itself, clamped to 1.
double lobePow(double dot, double alpha);

// Approximations. gamma is a power of two in [1, 64]; other values are rounded down to one. The
// maximum errors given are over all angles, for alpha much larger than gamma. If alpha < gamma,
// lyon, lyonTuned and pade leak past 90 degrees: choose gamma <= alpha.

/// The exponents to which the form `integer` raises by squaring: whole numbers in [1, 128].
bool isIntegerPower(double alpha);

/// The exact lobe as a product for exponents accepted by isIntegerPower; lobeExact for others.
double lobeInteger(double lambda, double alpha);

/// max(1 - beta lambda, 0)^gamma, beta = alpha / gamma (Lyon 1993): 0.271 (1/gamma - 1/alpha).
double lyon(double lambda, double alpha, int gamma);

/// The beta of lyonTuned, (alpha/gamma)(1 - 0.65 (1/gamma - 1/alpha)).
double tunedSlope(double alpha, int gamma);

/// lyon with tunedSlope, which is near the best slope: 0.13 / gamma.
double lyonTuned(double lambda, double alpha, int gamma);

/// Lyon's form on the cross product: lambda is replaced by |R x V|^2 / 2 = lambda (2 - lambda) / 2,
/// and the result is 0 unless R.V > 0 (without that gate it is 1 again at V = -R).
double lyonCross(double lambda, double alpha, int gamma);

/// (max(2 - (1 + beta) lambda, 0) / (2 + (beta - 1) lambda))^gamma, beta = alpha / gamma: the [1/1]
/// Pade approximant of (1 - lambda)^beta, raised to gamma: 0.112 / gamma^2.
double pade(double lambda, double alpha, int gamma);

/// Added to alpha in `gaussian`.
inline constexpr double gaussianShift = 0.69;

/// An entry of a table of max(dot, 0)^alpha over the cosine, at dot = place / steps, rounded to a
/// float as the shader gets it.
float lobeTableEntry(int place, double alpha, int steps);

/// A table with `steps` equal steps of the cosine (at least 1), interpolated linearly between
/// unrounded entries. For alpha >= 2 the error is at most alpha (alpha - 1) / (8 steps^2), next to
/// the peak; for smaller alpha it is largest next to 90 degrees (bounds.h).
double lobeTable(double dot, double alpha, int steps);

/// exp(-(alpha + 0.69) lambda), the spherical Gaussian: 0.134 / alpha. Not 0 past 90 degrees.
double gaussian(double lambda, double alpha);

}  // namespace glint
