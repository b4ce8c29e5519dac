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
  glm::ivec2 where{0};     ///< a pixel of the largest
  double mean = 0;         ///< over all pixels and channels
  std::size_t pixels = 0;  ///< that differ
};

/// What the window shows of A, or of A and B where the document compares them: opaque RGBA.
/// Transparent pixels stand over a checkerboard. B may be absent, else it has A's size.
std::vector<std::uint8_t> compose(const CodePicture& a, const CodePicture* b, const Document&,
                                  bool transparent);

/// Lays RGBA of straight alpha over opaque pixels of the same size.
void layOver(std::vector<std::uint8_t>& pixels, const std::vector<std::uint8_t>& layer);

/// How much two pictures differ.
CompareNumbers compareNumbers(const CodePicture& a, const CodePicture& b);

/// Marks pixels in place: magenta where a component is not a number, red where one is above 1 after
/// exposure, blue where one is negative; the rest becomes darker. Returns how many are marked.
std::size_t markClipped(std::vector<std::uint8_t>& codes, const Image& linear, double exposure);

}  // namespace glint::viewer
