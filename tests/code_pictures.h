#pragma once

// Pictures of 8-bit codes, generated in code.

#include <cstdint>
#include <functional>
#include <variant>
#include <vector>

#include "glint/image/stored_image.h"

namespace glint::test {

/// `colour` returns a pixel's channels.
inline StoredImage codes(int width, int height, int channels,
                         const std::function<std::vector<int>(int x, int y)>& colour) {
  StoredImage image{width, height, channels, std::vector<std::uint8_t>{}};
  auto& values = std::get<0>(image.values);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (const int code : colour(x, y)) values.push_back(static_cast<std::uint8_t>(code));
  return image;
}

inline StoredImage plain(int width, int height, const std::vector<int>& colour) {
  return codes(width, height, int(colour.size()), [&](int, int) { return colour; });
}

}  // namespace glint::test
