#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "glint/image/srgb_tables.h"

namespace glint {

// The sRGB curve (IEC 61966-2-1) between linear light and codes. Encoding to 8 bits is defined by
// thresholds, not by a formula, so that GLSL, C++ and the reference agree on every processor:
//
//     code(x) = the number of thresholds that are <= x          (NaN gives 0, and is counted)
//
// Threshold k (k = 1..255) is the float nearest to the linear value where the curve reaches
// (k - 0.5) / 255. Negative values give 0, values of 1 and more give 255; likewise the infinities.

/// The thresholds in ascending order; threshold k at index k - 1.
inline constexpr std::array<float, 255> srgbThresholds =
    detail::floatsOfBits(detail::srgbThresholdBits);

/// Code to linear light, [0, 1]: the float nearest to the exact value.
inline constexpr std::array<float, 256> srgbDecoded = detail::floatsOfBits(detail::srgbDecodedBits);

/// The curve itself, of a linear value from 0 on, and its inverse.
inline double srgbEncoded(double x) {
  return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
}
inline double srgbLinear(double x) {
  return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
}

/// The code of one linear value, as defined above.
std::uint8_t encodeSrgb8(float linear);

/// The linear value of an 8-bit code.
inline float decodeSrgb8(std::uint8_t code) { return srgbDecoded[code]; }

/// The code round(65535 * sRGB(x)) of one linear value, evaluated in double using only additions,
/// multiplications, divisions and square roots, so that it is the same on every processor. The
/// value before rounding is within 1e-10 of the exact one; NaN and negatives give 0, above 1 65535.
std::uint16_t encodeSrgb16(float linear);

/// The linear value of a 16-bit code, evaluated in double and rounded.
float decodeSrgb16(std::uint16_t code);

/// 8-bit straight-alpha RGBA from linear, premultiplied RGBA (what Image holds).
///
/// The code of a colour is that of value * scale (a float product; scale is the exposure factor,
/// finite and positive) where alpha >= 1, of (value * scale) / alpha where 0 < alpha < 1, and 0
/// where alpha is 0 or less. Alpha is linear: round(255 * alpha), neither scaled nor curved. `out`
/// has 4 * pixels bytes. Returns the number of pixels that contain a NaN.
std::size_t encodeSrgb8(const float* rgba, std::size_t pixels, float scale, std::uint8_t* out);

/// The same without alpha: 3 * pixels bytes of RGB; the alpha of the input is ignored, which gives
/// the picture over black. Returns the number of pixels with a NaN in their colour.
std::size_t encodeSrgb8Opaque(const float* rgba, std::size_t pixels, float scale,
                              std::uint8_t* out);

/// As encodeSrgb8 and encodeSrgb8Opaque, but with 16-bit codes in the processor's byte order.
std::size_t encodeSrgb16(const float* rgba, std::size_t pixels, float scale, std::uint16_t* out);
std::size_t encodeSrgb16Opaque(const float* rgba, std::size_t pixels, float scale,
                               std::uint16_t* out);

}  // namespace glint
