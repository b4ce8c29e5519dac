#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "glint/scene/look.h"

namespace glint {

/// A rectangle of a picture in its pixels; y counts from the top.
struct Tile {
  int x = 0, y = 0, width = 0, height = 0;
};

/// The parts in which a picture is drawn, through one buffer of the first part's size.
/// Interpolation rounds differently from part to part, so the layout belongs to the definition of
/// the picture: it depends only on resolution and anti-aliasing, and is the same on every machine
/// and in the window.
struct TileLayout {
  int bandHeight = 0;  ///< rows of a band; the last one may have fewer
  int tileWidth = 0;
  int scale = 1;    ///< ssaa: pixels drawn for each pixel of the picture, in x and in y
  int samples = 1;  ///< msaa
  std::vector<std::vector<Tile>> bands;  ///< from the top; the tiles of each from the left
};

/// At most 2 Mi samples a tile, 32 MiB of colour, and at most 8192 pixels a side.
/// docs/framebuffer.md has the figures behind this.
TileLayout tilesFor(glm::ivec2 resolution, const AntiAliasing&);

}  // namespace glint
