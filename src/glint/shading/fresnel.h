#pragma once

#include <glm/glm.hpp>
#include <optional>

namespace glint {

// Reflection and refraction at the smooth boundary between two dielectrics.
//
// Throughout: the ray comes from the medium with index n1; cosTheta is the cosine of the angle
// between the normal and the direction back along the ray, clamped to [0, 1] (NaN gives 0). Indices
// should lie in [1e-3, 1e3] and are clamped to [1e-9, 1e9]; code that reads them from a user
// rejects values outside. Equal indices are no boundary: the reflectance is 0, even at grazing
// incidence. Total reflection, and grazing incidence on unequal media, give exactly 1.

/// Values that depend only on the two indices, for one direction through the boundary: computed in
/// double once per material and side, and passed to the shaders. n = n2 / n1.
struct FresnelConstants {
  double n = 1.0;              ///< n2 / n1
  double nSquared = 1.0;       ///< n^2
  double nSquaredPlus1 = 2.0;  ///< n^2 + 1
  /// n^2 - 1, computed as d (2 + d) with d = (n2 - n1) / n1, where the difference of close indices
  /// is exact. Computed from n^2 it would lose all digits as n2 nears n1. Not 0 unless n1 == n2.
  double e = 0.0;
  double r0 = 0.0;  ///< the reflectance at normal incidence, ((n1 - n2) / (n1 + n2))^2
};

FresnelConstants fresnelConstants(double n1, double n2);

/// Both directions through the surface of a material of index `ior` seen from a medium of index
/// `mediumIor`: entering for front faces, leaving for back faces.
struct FresnelSides {
  FresnelConstants entering;
  FresnelConstants leaving;
};

FresnelSides fresnelSides(double ior, double mediumIor);

/// Reflectance by polarisation relative to the plane of incidence.
struct PolarizedReflectance {
  double perpendicular = 0.0;  ///< R_perp, s-polarised
  double parallel = 0.0;       ///< R_par, p-polarised, 0 at Brewster's angle
};

/// Fresnel's equations without cancellation. With g = n cos(theta_t), n = n2 / n1:
///     rs = e / (c + g)^2,  rp = e q / (n^2 c + g)^2,  q = (n^2 + 1) c^2 - 1,  g^2 = e + c^2,
/// the textbook amplitudes multiplied by their conjugates, so that no difference of nearly equal
/// rounded values is left except q, which vanishes where rp itself does. g^2 and q are computed
/// from (1 - c)(1 + c) where c^2 > 1/2 and n < 1. For n in [1e-3, 1e3] the error is below 1e-12 at
/// cosines more than 1e-4 from the critical one; closer, where the slope is infinite, it is the
/// error of g^2 (about 8 * 2^-53 c^2) divided by g.
PolarizedReflectance fresnelPolarized(double cosTheta, const FresnelConstants& constants);
PolarizedReflectance fresnelPolarized(double cosTheta, double n1, double n2);

/// Reflectance of unpolarised light, (R_perp + R_par) / 2. The notes print the sum (E1), which
/// exceeds 1.
double fresnelExact(double cosTheta, const FresnelConstants& constants);
double fresnelExact(double cosTheta, double n1, double n2);

/// The textbook equations, including the half (E1), from n1, n2 and cos(theta_t). For plots and the
/// cost table; loses digits near n1 = n2 and near the critical angle.
double fresnelTextbook(double cosTheta, double n1, double n2);

/// Schlick 1994: R0 + (1 - R0)(1 - c)^exponent; c is cosTheta where n1 < n2 and the cosine of the
/// refracted angle where n1 > n2 (de Greve 2006). The exponent is clamped to [0, 1e6].
double schlick(double cosTheta, const FresnelConstants& constants, double exponent = 5.0);
double schlick(double cosTheta, double n1, double n2, double exponent = 5.0);

/// Schlick with (1 - c)^5 replaced by 2^((-5.55473 c - 6.98316) c) (Lagarde 2013).
double schlickExp2(double cosTheta, const FresnelConstants& constants);
double schlickExp2(double cosTheta, double n1, double n2);

/// R0 + (1 - R0)((1 - c)/(1 + k c))^2, c as in schlick. k from rationalSlope or rationalMinimax.
double schlickRational(double cosTheta, const FresnelConstants& constants, double k);

/// The k that matches the exact slope at grazing incidence: (n+1)^2 (n^2+1) / (4 n sqrt(n^2-1)) - 1
/// with n the larger index over the smaller. Both directions have the same k; 0 if n1 == n2.
double rationalSlope(double n1, double n2);

/// The k with the smallest maximum error over all angles. At every angle the form falls as k grows,
/// so the largest overestimate falls and the largest underestimate grows with k: the best k is
/// where they are equal, found by bisection in [0, 64 (rationalSlope + 1)] to a relative 1e-7, on
/// 512 angles concentrated towards grazing. Above n = 11 the overestimate is larger for every k;
/// the end of the interval is then as good as any (error 0.2 and more: no form of this family suits
/// such n). Takes about 0.1 ms: once per material.
double rationalMinimax(double n1, double n2);

/// The cosine up to which all light is reflected: sqrt(1 - (n2/n1)^2); 0 unless n1 > n2.
double criticalCosine(double n1, double n2);

/// The angle of incidence in radians at which R_par is 0: atan(n2 / n1).
double brewsterAngle(double n1, double n2);

/// Reflectance of a metal of colour C at normal incidence: C + (1 - C)(1 - c)^5 (Schlick 1994).
glm::dvec3 metalReflectance(double cosTheta, const glm::dvec3& color);

/// The mirror direction of a unit incident direction: i - 2 (i.N) N.
glm::dvec3 reflect(const glm::dvec3& incident, const glm::dvec3& normal);

/// The refracted unit direction for a unit incident direction (which points to the surface), with
/// the normal on the side it comes from; empty for total reflection, that is where fresnelExact
/// gives 1 because g^2 <= 0. Computed in two parts: tangential (n1/n2)(i - (i.N) N), normal
/// -sqrt(1 - |tangential|^2) N, so that the length is 1 regardless of rounding. Equal indices give
/// the incident direction itself.
std::optional<glm::dvec3> refract(const glm::dvec3& incident, const glm::dvec3& normal, double n1,
                                  double n2);

}  // namespace glint
