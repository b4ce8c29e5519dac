#pragma once

#include <cstddef>
#include <vector>

#include "glint/study/picture_error.h"

namespace glint {

// The pictures of a study's page, as small PNG files: whole pictures of 60 variants in floats would
// take a gigabyte. Larger pictures are reduced by a whole factor, to 400 pixels a side at most.

/// The mean of each block of pixels, exposed and encoded.
std::vector<std::byte> pagePng(const Image& opaque, double exposureScale);

/// The largest error of each block on a logarithmic scale; grey where nothing is compared.
std::vector<std::byte> pageErrorPng(const Image& picture, const StudyMask&, const Radiances& truth);

}  // namespace glint
