#pragma once

#include <array>
#include <string_view>

namespace glint {

// Specular anti-aliasing: a highlight that is narrower than what a pixel sees of the normals is
// widened to that, and dimmed so that it sends the same light: --specular-antialiasing.

/// By what it is widened: how normals turn from pixel to pixel, or how far those that a smaller
/// level of the normal map stands for are apart.
enum class SpecularAntialiasing { none, kaplanyan, toksvig };

inline constexpr std::array<std::string_view, 3> specularAntialiasingNames{"none", "kaplanyan",
                                                                           "toksvig"};

// Kaplanyan, Hill, Patney and Lefohn, Filtering Distributions of Normals for Shading Antialiasing,
// 2016, with the isotropic kernel of normals of Tokuyoshi and Kaplanyan, Improved Geometric
// Specular Antialiasing, 2019, and Stable Geometric Specular Antialiasing with Projected-Space NDF
// Filtering, 2021: the width a^2 of the distribution of normals grows by
//     k = min(2 s^2 (|dN/dx|^2 + |dN/dy|^2), 0.18),  s^2 = 1 / (2 pi) pixels^2,
// s^2 the variance of the pixel's kernel, a Gaussian. The exponent and a go by a^2 = 2 / (n + 2)
// (Walter et al. 2007; n Blinn-Phong's; four times Phong's), and the peak by the normalisation of
// that distribution, (n + 2) / (2 pi). The sum of both directions stands for either: of normals
// that turn in one direction alone twice the variance is too much by a factor of one, of a sphere's
// by two, so that what is filtered is a little too wide, never too narrow.
//
// Normals alone count: the change of H by near lights or a near eye is left out. So it is meant for
// lights and eyes farther away than the surface is curved.

inline constexpr double pixelVariance = 0.15915494309189535;  ///< s^2, pixels^2
inline constexpr double largestWidening = 0.18;               ///< of a^2

/// What a lobe becomes.
struct FilteredLobe {
  double exponent = 0;
  double scale = 1;  ///< of its peak, (0, 1]
};

/// `turn` is |dN/dx|^2 + |dN/dy|^2 of the unit normal from pixel to pixel, at least 0 (below, and
/// NaN, it counts as that); exponent >= 0 of the lobe of Blinn-Phong or of Phong.
FilteredLobe filteredLobe(double exponent, bool blinn, double turn);

// Toksvig, Mipmapping Normal Maps, Journal of Graphics Tools 10 (3), 2005: the mean N of unit
// normals is the shorter the farther they are apart; of slopes that are normally distributed with
// the variance v it is about 1 / (1 + v) long, so that v = (1 - |N|) / |N|. Blinn-Phong's lobe of
// the exponent n becomes that of n / (1 + n v), its peak (1 + n') / (1 + n) of what it was. Phong's
// R turns twice as far as N: a becomes a / (1 + 4 a v), the peak likewise, which keeps all of its
// light, 2 pi / (a + 1).
//
// |N| cannot be had from a level's own texels: of 8 bits, they are off by up to 0.007 in length, as
// if an exponent of 140 were the most there is. src/glint/render/normal_lengths.h computes it.

/// `variance` is v, at least 0 (below, and NaN, it counts as that).
FilteredLobe toksvigLobe(double exponent, bool blinn, double variance);

}  // namespace glint
