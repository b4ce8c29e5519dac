#include "glint/shading/half.h"

#include <cmath>

namespace glint {

std::uint16_t halfBits(double x) {
  const std::uint16_t sign = std::signbit(x) ? 0x8000 : 0;
  if (std::isnan(x)) return std::uint16_t(sign | 0x7e00);
  const double size = std::abs(x);
  if (size >= 65520) return std::uint16_t(sign | 0x7c00);
  // In units of the last bit, 2^-24 below the smallest normal number 2^-14.
  const int exponent = size < 0x1p-14 ? -14 : std::ilogb(size);
  const double steps = std::nearbyint(std::ldexp(size, 10 - exponent));  // ties to even
  // Normal numbers have 1024 to 2048 steps; 2048 carries into the exponent by itself.
  return std::uint16_t(sign | (std::uint32_t(exponent + 14) * 1024 + std::uint32_t(steps)));
}

double halfValue(std::uint16_t bits) {
  const int exponent = bits >> 10 & 31, fraction = bits & 1023;
  const double sign = (bits & 0x8000) != 0 ? -1 : 1;
  if (exponent == 31) return fraction != 0 ? std::nan("") : sign * HUGE_VAL;
  if (exponent == 0) return sign * std::ldexp(fraction, -24);
  return sign * std::ldexp(1024 + fraction, exponent - 25);
}

}  // namespace glint
