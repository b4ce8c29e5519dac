#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "document.h"
#include "glint/image/image.h"

namespace glint::viewer {

/// 8-bit RGBA pixels, rows from the top, straight alpha.
struct CodePicture {
  int width = 0, height = 0;
  const std::uint8_t* codes = nullptr;
};

struct CompareNumbers {
  int largest = 0;         ///< 8-bit levels
  glm::ivec2 where{0};     ///< a pixel with the largest difference
  double mean = 0;         ///< over all pixels and channels
  std::size_t pixels = 0;  ///< that differ
};

/// What the window shows: A, or A and B if the document compares them; opaque RGBA. Transparent
/// pixels appear over a checkerboard. B may be null; otherwise it has A's size.
std::vector<std::uint8_t> compose(const CodePicture& a, const CodePicture* b, const Document&,
                                  bool transparent);

/// Blends RGBA with straight alpha over opaque pixels of the same size.
void layOver(std::vector<std::uint8_t>& pixels, const std::vector<std::uint8_t>& layer);

/// The difference between two pictures.
CompareNumbers compareNumbers(const CodePicture& a, const CodePicture& b);

/// Marks pixels in place: magenta if a component is not a number, red if one is above 1 after
/// exposure, blue if one is negative; all others become darker. Returns the number of marked
/// pixels.
std::size_t markClipped(std::vector<std::uint8_t>& codes, const Image& linear, double exposure);

}  // namespace glint::viewer
