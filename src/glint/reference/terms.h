#pragma once

#include "glint/render/decode.h"
#include "glint/render/picture_terms.h"

namespace glint {

/// Draws a term as drawTerm() does, in double precision and without GL.
Image drawReferenceTerm(const Scene&, const DecodedImages&, const Bounds&, const Look& look,
                        const PictureTerm&);

}  // namespace glint
