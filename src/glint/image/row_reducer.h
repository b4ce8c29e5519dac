#pragma once

#include <cstdint>
#include <vector>

#include "glint/image/texture.h"

namespace glint {

/// Makes a picture smaller while its rows arrive, so that the whole of it is never held: sides are
/// halved a number of times and rounded down (1 at least), each pixel is the mean over the area
/// that it covers, colours in linear light, alpha as it is; as mipLevels() does it (mipmaps.h).
class RowReducer {
 public:
  /// `isData`: the values are numbers, not sRGB. Throws std::bad_alloc.
  RowReducer(int width, int height, int halvings, bool isData);

  /// The next row from the top, `width` pixels of straight RGBA. Rows beyond the last are ignored.
  void add(const std::uint8_t* rgba);

  /// The picture; once all rows have come.
  ByteImage take() { return std::move(image_); }

 private:
  void finishRow();

  struct Span {
    int first, count;  ///< pixels of the row; their weights stand in weights_
  };
  int width_, height_, row_ = 0, done_ = 0;
  bool isData_;
  std::vector<Span> columns_;
  std::vector<float> weights_;
  std::vector<float> line_, sum_;  ///< linear RGBA of the smaller width
  ByteImage image_;
};

}  // namespace glint
