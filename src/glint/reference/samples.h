#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "glint/reference/raster.h"
#include "glint/scene/look.h"

namespace glint::reference {

/// Where the samples of a pixel lie, from its centre, y upwards; none without multisampling.
/// Direct3D 11's standard pattern of 2, 4, 8 and 16 samples, which GL drivers use too (llvmpipe
/// among them); ReferenceRenderer::sampleAt() takes other patterns. Throws InputError for other
/// numbers of samples.
std::vector<glm::dvec2> samplePattern(const AntiAliasing&);

/// Where in a pixel a primitive is shaded, from the pixel's centre: for a triangle the mean of the
/// samples that it covers; the centre itself if it covers all or none of them. For a line the
/// centre, whose foot on the line it is that counts; beyond an end of the line, that end. So the
/// place is never outside the primitive.
glm::dvec2 shadingPlace(const Primitive&, const std::vector<glm::dvec2>& samples, double middleX,
                        double middleY);

}  // namespace glint::reference
