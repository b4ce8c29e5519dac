#pragma once

#include "glint/image/texture.h"
#include "glint/scene/scene.h"

namespace glint {

/// Replaces the texels of a picture by what GlossPicture makes of them: the diffuse picture's by C
/// and alpha, the other one's by roughness (G), metallic (B) and reflectance (A), each to the
/// nearest code. `other` is the picture beside it, read bilinearly where its size differs, white
/// without one.
void convertGlossPicture(ByteImage& picture, const ByteImage* other, const GlossPicture& made);

}  // namespace glint
