#pragma once

#include <cstdint>

namespace glint {

// IEEE 754's binary16, the "half" of GPUs and phones (mediump): 11 significant bits, from 2^-24 to
// 65504. In software, bit for bit.

/// The bits of the nearest half, ties to even; infinity beyond 65520; subnormals are kept; NaN
/// gives 0x7e00 with its sign.
std::uint16_t halfBits(double x);

/// The value of a half's bits, exactly.
double halfValue(std::uint16_t bits);

/// The value of the nearest half.
inline double roundedToHalf(double x) { return halfValue(halfBits(x)); }

/// A half with correctly rounded operations. (Sums, products and quotients of halves computed in
/// double and rounded again are correctly rounded, since double has more than 2 x 11 + 2 bits.)
class Half {
 public:
  Half(double x) : value_(roundedToHalf(x)) {}  // NOLINT: numbers become halves where they are used
  double value() const { return value_; }
  friend Half operator+(Half a, Half b) { return a.value_ + b.value_; }
  friend Half operator-(Half a, Half b) { return a.value_ - b.value_; }
  friend Half operator*(Half a, Half b) { return a.value_ * b.value_; }
  friend Half operator/(Half a, Half b) { return a.value_ / b.value_; }

 private:
  double value_;
};

}  // namespace glint
