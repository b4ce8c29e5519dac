#include "glint/render/tiles.h"

#include <algorithm>

namespace glint {

TileLayout tilesFor(glm::ivec2 resolution, const AntiAliasing& antiAliasing) {
  constexpr int maxSamples = 1 << 21, maxAcross = 8192;
  TileLayout layout;
  if (antiAliasing.mode == AntiAliasing::Mode::ssaa) layout.scale = antiAliasing.count;
  if (antiAliasing.mode == AntiAliasing::Mode::msaa) layout.samples = antiAliasing.count;

  const auto evenly = [](int whole, int most) {
    const int parts = (whole + most - 1) / most;
    return (whole + parts - 1) / parts;
  };
  layout.tileWidth = evenly(resolution.x, std::max(1, maxAcross / layout.scale));
  const int rowSamples = layout.tileWidth * layout.scale * layout.scale * layout.samples;
  layout.bandHeight = evenly(
      resolution.y, std::clamp(maxSamples / rowSamples, 1, std::max(1, maxAcross / layout.scale)));
  for (int y = 0; y < resolution.y; y += layout.bandHeight) {
    auto& band = layout.bands.emplace_back();
    for (int x = 0; x < resolution.x; x += layout.tileWidth)
      band.push_back({x, y, std::min(layout.tileWidth, resolution.x - x),
                      std::min(layout.bandHeight, resolution.y - y)});
  }
  return layout;
}

}  // namespace glint
