#pragma once

#include "material_textures.h"
#include "measured.h"

namespace glint::viewer {

/// A ball of a material in the default light, as small as a picture in a list: the sum in double,
/// without environment, over black corners of alpha 0. sRGB.
Thumbnail ballOf(const ShadingParameters&, const FitForm&, int side);

}  // namespace glint::viewer
