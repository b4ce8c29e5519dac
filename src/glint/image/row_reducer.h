#pragma once

#include <cstdint>
#include <vector>

#include "glint/image/row_average.h"
#include "glint/image/texture.h"

namespace glint {

/// Scales a picture down while its rows arrive, so that the whole of it is never held. Sides are
/// halved a number of times and rounded down (to at least 1); each pixel is the mean over the area
/// that it covers, colours in linear light, alpha unchanged, as in mipLevels() (mipmaps.h).
class RowReducer {
 public:
  /// `isData`: the values are numbers, not sRGB. Throws std::bad_alloc.
  RowReducer(int width, int height, int halvings, bool isData);
  RowReducer(const RowReducer&) = delete;
  RowReducer& operator=(const RowReducer&) = delete;

  /// The next row from the top, `width` pixels of straight RGBA. Rows beyond the last are ignored.
  void add(const std::uint8_t* rgba);

  /// The picture, once all rows have been added.
  ByteImage take() { return std::move(image_); }

 private:
  bool isData_;
  ByteImage image_;
  std::vector<float> line_;  ///< one row of the input picture
  RowAverage average_;
};

}  // namespace glint
