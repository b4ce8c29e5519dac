#pragma once

#include <string>

#include "glint/render/draw_list.h"
#include "glint/render/tiles.h"

namespace glint {

/// The widest points and lines that the current context draws, in pixels.
struct ThinLimits {
  float point = 1, line = 1;
};
ThinLimits thinLimits();

/// Whether the list has points or lines and the picture is anti-aliased: they then reach beyond the
/// pixels that their middle lies in.
bool hasWideThins(const Scene&, const DrawList&, const TileLayout&);

/// Makes points and lines `width` pixels wide while it lives, or as wide as the driver can.
class ThinWidth {
 public:
  explicit ThinWidth(int width);
  ~ThinWidth();
  ThinWidth(const ThinWidth&) = delete;
  ThinWidth& operator=(const ThinWidth&) = delete;
};

/// What users are told if the driver's points or lines cannot be `width` wide; else empty.
std::string thinWarning(const ThinLimits&, int width);

}  // namespace glint
