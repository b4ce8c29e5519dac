#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "glint/image/image.h"

namespace glint::viewer {

/// The error of a picture against its reference, in linear light before exposure, over the colours.
struct ErrorNumbers {
  double largest = 0;
  glm::ivec2 where{0};  ///< the pixel with the largest error
  double rmse = 0;
  int levels = 0;             ///< the largest difference in 8-bit levels, with exposure
  std::size_t edges = 0;      ///< pixels left out: see ReferencePicture::edges
  std::size_t notFinite = 0;  ///< pixels left out because one of the two is not finite
};

/// Compares the first `rows` rows of two pictures of equal size. `edges` is empty or has one value
/// per pixel.
ErrorNumbers errorNumbers(const Image& picture, const Image& exact,
                          const std::vector<std::uint8_t>& edges, int rows, double exposure);

/// Errors from this to 1 have colours, evenly spaced in the logarithm; smaller ones are black.
inline constexpr double leastError = 1e-8;

/// The position of an error on the colour scale, [0, 1].
double errorShade(double error);

/// The colours of the scale from 0 to 1: RGBA.
std::vector<std::uint8_t> errorScale(int steps);

/// The largest error over the colours for each pixel of the first `rows` rows, as opaque RGBA of
/// the Magma map at errorShade(). Rows below are grey, pixels that are not finite green.
std::vector<std::uint8_t> errorMap(const Image& picture, const Image& exact, int rows);

}  // namespace glint::viewer
