#pragma once

#include "glint/image/texture.h"
#include "glint/scene/scene.h"

namespace glint {

/// Converts the texels of a picture as GlossPicture describes: to C and alpha if `made.isColor`,
/// otherwise to roughness (G), metallic (B) and reflectance (A), each rounded to the nearest code.
/// `other` is the second picture of the pair, read bilinearly where its size differs; null counts
/// as white.
void convertGlossPicture(ByteImage& picture, const ByteImage* other, const GlossPicture& made);

}  // namespace glint
