#pragma once

#include <vector>

#include "glint/image/texture.h"

namespace glint {

/// The smaller levels of a texture's mip pyramid, from half its size down to 1 x 1. Sizes are
/// halved and rounded down; each texel is the mean over the area it covers (with fractional weights
/// where a size is odd), colours in linear light, alpha unchanged. Values are carried down the
/// pyramid as floats and rounded once: colours to sRGB by the threshold encode, alpha to the
/// nearest code.
///
/// glGenerateMipmap is not used because drivers differ in rounding and in their treatment of odd
/// sizes, and because a software driver compiles programs for it in every process.
///
/// `isData`: the values are numbers, not sRGB, and are averaged and rounded directly.
std::vector<ByteImage> mipLevels(const ByteImage& image, bool isData = false);

}  // namespace glint
