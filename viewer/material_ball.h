#pragma once

#include "material_textures.h"
#include "measured.h"

namespace glint::viewer {

/// Renders a thumbnail of a ball with this material in the default light: the sum in double,
/// without an environment; the corners are black with alpha 0. sRGB.
Thumbnail ballOf(const ShadingParameters&, const FitForm&, int side);

}  // namespace glint::viewer
