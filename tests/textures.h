#pragma once

// Pictures for textures, with known codes.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "glint/image/png_bytes.h"

namespace glint::test {

/// An 8-bit RGBA PNG with these codes.
inline std::vector<std::byte> png(int width, int height,
                                  const std::function<glm::ivec4(int x, int y)>& code) {
  std::vector<std::uint8_t> codes;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int k = 0; k < 4; ++k) codes.push_back(std::uint8_t(code(x, y)[k]));
  return pngOfRgba(codes, width, height);
}

}  // namespace glint::test
