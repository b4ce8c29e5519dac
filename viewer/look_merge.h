#pragma once

#include "glint/scene/look.h"

namespace glint::viewer {

/// `theirs`, except that each parameter, also of a material, that differs between `base` and `mine`
/// is taken from `mine`.
Look mergedLook(const Look& mine, const Look& base, const Look& theirs);

}  // namespace glint::viewer
