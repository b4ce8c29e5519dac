#pragma once

#include <array>
#include <string_view>

namespace glint {

// Specular anti-aliasing: a highlight narrower than the spread of normals within a pixel is widened
// to that spread, and dimmed so that it sends the same light: --specular-antialiasing.

/// What determines the widening: how normals turn from pixel to pixel, or how far apart the normals
/// averaged in a smaller level of the normal map are.
enum class SpecularAntialiasing { none, kaplanyan, toksvig };

inline constexpr std::array<std::string_view, 3> specularAntialiasingNames{"none", "kaplanyan",
                                                                           "toksvig"};

// Kaplanyan, Hill, Patney and Lefohn, Filtering Distributions of Normals for Shading Antialiasing,
// 2016, with the isotropic kernel of normals of Tokuyoshi and Kaplanyan, Improved Geometric
// Specular Antialiasing, 2019, and Stable Geometric Specular Antialiasing with Projected-Space NDF
// Filtering, 2021: the width a^2 of the distribution of normals grows by
//     k = min(2 s^2 (|dN/dx|^2 + |dN/dy|^2), 0.18),  s^2 = 1 / (2 pi) pixels^2,
// where s^2 is the variance of the pixel's kernel, a Gaussian. The exponent and a are related by
// a^2 = 2 / (n + 2) (Walter et al. 2007; n is Blinn-Phong's, four times Phong's), and the peak by
// the normalisation of that distribution, (n + 2) / (2 pi). The sum over both directions is used
// for each. Compared with twice the variance, it is exact for normals that turn in one direction
// only and too large by a factor of two for a sphere's, so the result is a little too wide, never
// too narrow.
//
// Only normals count: the change of H due to near lights or a near eye is ignored. This is
// therefore meant for lights and eyes at distances larger than the surface's radius of curvature.

inline constexpr double pixelVariance = 0.15915494309189535;  ///< s^2, pixels^2
inline constexpr double largestWidening = 0.18;               ///< of a^2

/// The filtered lobe.
struct FilteredLobe {
  double exponent = 0;
  double scale = 1;  ///< of its peak, (0, 1]
};

/// `turn` is |dN/dx|^2 + |dN/dy|^2 of the unit normal from pixel to pixel, at least 0 (negative
/// values and NaN count as 0); exponent >= 0, of the Blinn-Phong or Phong lobe.
FilteredLobe filteredLobe(double exponent, bool blinn, double turn);

// Toksvig, Mipmapping Normal Maps, Journal of Graphics Tools 10 (3), 2005: the mean N of unit
// normals is shorter the farther apart they are; for slopes that are normally distributed with
// variance v its length is about 1 / (1 + v), so that v = (1 - |N|) / |N|. Blinn-Phong's lobe with
// exponent n becomes that of n' = n / (1 + n v), its peak (1 + n') / (1 + n) of what it was.
// Phong's R turns twice as far as N: a becomes a / (1 + 4 a v), and the peak changes likewise,
// which keeps all of its light, 2 pi / (a + 1).
//
// |N| cannot be computed from a level's own texels: with 8 bits their lengths are off by up to
// 0.007, as if no exponent could exceed 140. src/glint/render/normal_lengths.h computes it.

/// `variance` is v, at least 0 (negative values and NaN count as 0).
FilteredLobe toksvigLobe(double exponent, bool blinn, double variance);

}  // namespace glint
