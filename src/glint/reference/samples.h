#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "glint/reference/raster.h"
#include "glint/scene/look.h"

namespace glint::reference {

/// Where the samples of a pixel lie, from its middle, y upwards; none without multisampling. The
/// pattern that Direct3D 11 fixes for 2, 4, 8 and 16 samples, which drivers of GL have too (that of
/// llvmpipe among them); ReferenceRenderer::sampleAt() takes others. Throws InputError for other
/// numbers.
std::vector<glm::dvec2> samplePattern(const AntiAliasing&);

/// Where in a pixel a primitive is shaded, from its middle: the mean of the samples that it covers,
/// and so never outside of it; the middle itself if it covers all of them. Lines and points cover
/// whole pixels.
glm::dvec2 shadingPlace(const Primitive&, const std::vector<glm::dvec2>& samples, double middleX,
                        double middleY);

}  // namespace glint::reference
