#pragma once

#include <functional>

namespace glint {

/// A picture as rows of linear RGBA floats, computed on request, so that pictures too large to fit
/// in memory as floats can be compared. Several threads may call `read` at once.
struct PixelRows {
  int width = 0;   ///< pixels, at least 1
  int height = 0;  ///< rows, at least 1
  /// Fills `rgba` with the 4 * width * count floats of `count` rows starting at `first`.
  std::function<void(int first, int count, float* rgba)> read;
  /// The largest distance between rows that should be requested concurrently: beyond it, rows are
  /// decoded again, which is slow. 0: no limit.
  int reach = 0;
};

}  // namespace glint
