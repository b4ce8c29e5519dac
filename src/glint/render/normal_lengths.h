#pragma once

#include <cstdint>

#include "glint/render/decode.h"

namespace glint {

/// How far apart the normals are that a texel of a smaller level stands for, as a code: the mean of
/// their unit vectors is `length` long, their variance is v = (1 - length) / length
/// (glint/shading/specular_filter.h), and the code 255 - 255 sqrt(v), rounded. 255, the opaque
/// alpha of a picture without one, is no spread at all, and the next code below it 1.5e-5, the
/// variance of a lobe of the exponent 65,000; 0 is 1 and all above, of lengths up to a half.
std::uint8_t normalSpreadCode(double length);

/// The alpha of a normal map and of its smaller levels becomes normalSpreadCode() of the base's
/// texels that each texel covers: 255 in the base itself, so that what is magnified has no spread.
/// Their colours stay as they are.
void writeNormalLengths(DecodedImage&);

}  // namespace glint
