#pragma once

#include <vector>

#include "glint/image/texture.h"

namespace glint {

/// The smaller levels of a texture's pyramid, from half its size down to 1 x 1: sizes halved and
/// rounded down, each texel the mean over the area it covers (weights of the parts of texels where
/// a size is odd), colours in linear light, alpha as it is. Values are rounded once, from floats
/// carried down the pyramid, to sRGB by the threshold encode, alpha to the nearest.
///
/// Made here and not by glGenerateMipmap, because drivers differ in rounding and odd sizes, and
/// because a software driver compiles programs for it in every process.
///
/// `isData`: the values are numbers, not sRGB, and are averaged and rounded as they are.
std::vector<ByteImage> mipLevels(const ByteImage& image, bool isData = false);

}  // namespace glint
