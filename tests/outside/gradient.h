#pragma once

#include "glint/image/image.h"

/// A grey ramp from left to right, with a square that has `planted` / 255 in red.
inline glint::Image gradient(int planted) {
  glint::Image image{64, 32, {}};
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const float grey = float(x) / 63;
      const bool square = x >= 20 && x < 28 && y >= 10 && y < 18;
      const float red = square ? grey + float(planted) / 255 : grey;
      image.values.insert(image.values.end(), {red, grey, grey, 1});
    }
  return image;
}
