#pragma once

#include <cstdint>
#include <vector>

#include "glint/image/row_average.h"
#include "glint/image/texture.h"

namespace glint {

/// Makes a picture smaller while its rows arrive, so that the whole of it is never held: sides are
/// halved a number of times and rounded down (1 at least), each pixel is the mean over the area
/// that it covers, colours in linear light, alpha as it is; as mipLevels() does it (mipmaps.h).
class RowReducer {
 public:
  /// `isData`: the values are numbers, not sRGB. Throws std::bad_alloc.
  RowReducer(int width, int height, int halvings, bool isData);
  RowReducer(const RowReducer&) = delete;
  RowReducer& operator=(const RowReducer&) = delete;

  /// The next row from the top, `width` pixels of straight RGBA. Rows beyond the last are ignored.
  void add(const std::uint8_t* rgba);

  /// The picture; once all rows have come.
  ByteImage take() { return std::move(image_); }

 private:
  bool isData_;
  ByteImage image_;
  std::vector<float> line_;  ///< a row of the picture given
  RowAverage average_;
};

}  // namespace glint
