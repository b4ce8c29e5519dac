#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "glint/image/image.h"

namespace glint::viewer {

/// How far a picture is from its reference, in linear light before exposure, over colours.
struct ErrorNumbers {
  double largest = 0;
  glm::ivec2 where{0};  ///< the pixel of the largest
  double rmse = 0;
  int levels = 0;             ///< the largest difference of 8-bit values, with exposure
  std::size_t edges = 0;      ///< pixels left out: see ReferencePicture::edges
  std::size_t notFinite = 0;  ///< pixels left out, because one of the two is not finite
};

/// Of the first `rows` rows of two pictures of one size. `edges` is empty or has one value a pixel.
ErrorNumbers errorNumbers(const Image& picture, const Image& exact,
                          const std::vector<std::uint8_t>& edges, int rows, double exposure);

/// Errors from this to 1 have colours, in steps as even as their logarithms; less is black.
inline constexpr double leastError = 1e-8;

/// The place of an error on the colour scale, [0, 1].
double errorShade(double error);

/// The colours of the scale from 0 to 1: RGBA.
std::vector<std::uint8_t> errorScale(int steps);

/// Opaque RGBA of the largest error over the colours of each pixel of the first `rows` rows, by the
/// Magma map over errorShade; rows below are grey, pixels that are not finite green.
std::vector<std::uint8_t> errorMap(const Image& picture, const Image& exact, int rows);

}  // namespace glint::viewer
