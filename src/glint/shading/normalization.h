#pragma once

#include <array>
#include <string_view>

namespace glint {

// The factor of a highlight that makes it send the same amount of light whatever its exponent:
// --normalization. m_s is then the share of the arriving light that the highlight reflects.
//
// Units are those of the sum (sum.h), in which a white diffuse surface (m_d = 1) sends 1 under
// uniform light of 1 from everywhere: intensities stand for irradiance over pi, so that a factor k
// here is pi times the BRDF's. The notes' highlight has no N.L, so that in such a furnace a surface
// seen from V shows m_s (k / pi) times the integral of the lobe over all L with N.L > 0.

/// `none`: the notes' formula, 1. With n the exponent of the lobe (Blinn-Phong's own):
///
/// `simple`: the customary (n + 2) / (2 pi) for Phong (Lewis 1994; Lafortune and Willems 1994) and
/// (n + 8) / (8 pi) for Blinn-Phong (Akenine-Moeller, Haines, Hoffman 2008), here (n + 2) / 2 and
/// (n + 8) / 8. They are meant for a highlight with N.L; without it they send too much, at most
/// twice (n = 0): (n + 2) / (n + 1) and (n + 8) (2 - 2^(-n/2)) / (2 (n + 2)) times `exact`.
///
/// `exact`: without N.L (Giesen 2009), (n + 1) / (2 pi) and (n + 2) / (4 pi (2 - 2^(-n/2))), here
/// (n + 1) / 2 and (n + 2) / (4 (2 - 2^(-n/2))): along the normal the furnace shows m_s, and no
/// direction shows more. Phong's lobe, up to half of which the horizon cuts off, shows at least
/// m_s / 2; Blinn-Phong's, whose highlight narrows towards the horizon, about m_s N.V for large n.
enum class Normalization { none, simple, exact };

/// For n in [0, 1e9]; values outside are clamped, NaN counts as 0. At least 1/2.
double lobeNormalization(Normalization, bool blinn, double n);

/// The name of the same function of n in glsl/normalization.glsl; not for `none`.
std::string_view normalizationGlsl(Normalization, bool blinn);

inline constexpr std::array<std::string_view, 3> normalizationNames{"none", "simple", "exact"};

}  // namespace glint
