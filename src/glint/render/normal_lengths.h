#pragma once

#include <cstdint>

#include "glint/render/decode.h"

namespace glint {

/// The spread of the normals that a texel of a smaller level covers, as a code. `length` is that of
/// the mean of their unit vectors, their variance is v = (1 - length) / length
/// (glint/shading/specular_filter.h), and the code is 255 - 255 sqrt(v), rounded. 255, the opaque
/// alpha of a picture without alpha, means no spread; 254 means v = 1.5e-5, the variance of a lobe
/// with exponent 65,000; 0 means v = 1 or more, lengths up to a half.
std::uint8_t normalSpreadCode(double length);

/// Sets the alpha of a normal map's smaller levels to normalSpreadCode() of the base's texels that
/// each texel covers, and that of the base to 255, so that magnified texels have no spread. The
/// colours stay as they are.
void writeNormalLengths(DecodedImage&);

}  // namespace glint
