#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace glint {

/// A picture in linear light: rows from the top, RGBA interleaved, colour premultiplied by alpha.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<float> values;  ///< 4 * width * height
  /// Text stored in the file about the picture: keyword and text (UTF-8).
  std::map<std::string, std::string> text = {};

  float* row(int y) { return values.data() + std::size_t(4) * width * y; }
  const float* row(int y) const { return values.data() + std::size_t(4) * width * y; }
};

}  // namespace glint
