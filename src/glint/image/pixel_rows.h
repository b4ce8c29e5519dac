#pragma once

#include <functional>

namespace glint {

/// A picture as rows of linear RGBA floats, made when they are asked for, so that pictures that do
/// not fit the memory as floats can be compared. `read` may be called by several threads at once.
struct PixelRows {
  int width = 0;   ///< pixels, at least 1
  int height = 0;  ///< rows, at least 1
  /// Fills `rgba` with 4 * width * count floats of the rows from `first` on.
  std::function<void(int first, int count, float* rgba)> read;
  /// How far apart rows should be asked for at the same time: beyond it they are made anew, which
  /// takes long. 0: does not matter.
  int reach = 0;
};

}  // namespace glint
