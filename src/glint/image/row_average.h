#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace glint {

/// Scales a picture down while its rows arrive: each output pixel is the mean over the area that it
/// covers (with fractional weights where a size is not a multiple).
class RowAverage {
 public:
  /// `finished` gets each row of the smaller picture, RGBA, from the top, as soon as the rows that
  /// it covers have arrived. Sizes are at least 1, and the smaller picture's are at most the
  /// original's.
  RowAverage(int width, int height, int toWidth, int toHeight,
             std::function<void(std::span<const float>)> finished);

  /// The next row from the top, RGBA of `width` pixels. Rows beyond the last are ignored.
  void add(const float* row);

 private:
  void averageAcross(const float* row);

  struct Span {
    int first, count;  ///< pixels of the row; their weights are in weights_
  };
  int height_, toWidth_, toHeight_, row_ = 0, done_ = 0;
  std::vector<Span> columns_;  ///< empty if each output pixel covers exactly two
  std::vector<float> weights_;
  std::vector<float> line_, sum_;
  std::function<void(std::span<const float>)> finished_;
};

/// Texels of a row as RowAverage takes them: colours in linear light, numbers (`isData`) and alpha
/// as codes from 0 to 255, whose means are then exact over many levels.
void decodeTexels(std::span<const std::uint8_t> codes, bool isData, float* row);

/// The nearest codes: colours by the thresholds in srgb.h, numbers and alpha rounded.
void encodeTexels(std::span<const float> row, bool isData, std::uint8_t* codes);

}  // namespace glint
