#pragma once

#include "glint/scene/look.h"

namespace glint::viewer {

/// `theirs`, with each parameter, and each of a material, that differs between `base` and `mine` as
/// it is in `mine`.
Look mergedLook(const Look& mine, const Look& base, const Look& theirs);

}  // namespace glint::viewer
