// The layout of a picture's tiles.

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "glint/render/tiles.h"

namespace glint::tiles_test {

const AntiAliasing antiAliasings[] = {
    {AntiAliasing::Mode::none, 1}, {AntiAliasing::Mode::msaa, 4}, {AntiAliasing::Mode::msaa, 64},
    {AntiAliasing::Mode::ssaa, 2}, {AntiAliasing::Mode::ssaa, 3}, {AntiAliasing::Mode::ssaa, 16}};

const glm::ivec2 resolutions[] = {{1, 1},       {1, 65535},   {65535, 1}, {7, 5},
                                  {1024, 1024}, {1920, 1080}, {8193, 3},  {4099, 2053},
                                  {8192, 257},  {16385, 1031}};

TEST(Tiles, CoverEveryPixelExactlyOnceFromTheTop) {
  for (const glm::ivec2 resolution : resolutions)
    for (const AntiAliasing& antiAliasing : antiAliasings) {
      SCOPED_TRACE(testing::Message() << resolution.x << "x" << resolution.y << " "
                                      << int(antiAliasing.mode) << ":" << antiAliasing.count);
      const TileLayout layout = tilesFor(resolution, antiAliasing);
      int y = 0;
      for (const auto& band : layout.bands) {
        ASSERT_FALSE(band.empty());
        int x = 0;
        for (const Tile& tile : band) {
          EXPECT_EQ(tile.x, x);
          EXPECT_EQ(tile.y, y);
          EXPECT_EQ(tile.height, band.front().height);
          EXPECT_GT(tile.width, 0);
          x += tile.width;
        }
        EXPECT_EQ(x, resolution.x);
        EXPECT_GT(band.front().height, 0);
        y += band.front().height;
      }
      EXPECT_EQ(y, resolution.y);
    }
}

TEST(Tiles, FitOneBufferOfTheFirstTilesSize) {
  for (const glm::ivec2 resolution : resolutions)
    for (const AntiAliasing& antiAliasing : antiAliasings) {
      const TileLayout layout = tilesFor(resolution, antiAliasing);
      EXPECT_EQ(layout.tileWidth, layout.bands.front().front().width);
      EXPECT_EQ(layout.bandHeight, layout.bands.front().front().height);
      for (const auto& band : layout.bands)
        for (const Tile& tile : band) {
          EXPECT_LE(tile.width, layout.tileWidth);
          EXPECT_LE(tile.height, layout.bandHeight);
        }
      EXPECT_LE(layout.tileWidth * layout.scale, 8192);
      // One row of a tile is the minimum, whatever its number of samples.
      const long samples =
          long(layout.tileWidth) * layout.bandHeight * layout.scale * layout.scale * layout.samples;
      EXPECT_TRUE(samples <= 1 << 21 || layout.bandHeight == 1) << samples;
    }
}

TEST(Tiles, HoldTheSamplesThatWereAskedFor) {
  for (const AntiAliasing& antiAliasing : antiAliasings) {
    const TileLayout layout = tilesFor({640, 480}, antiAliasing);
    const bool ssaa = antiAliasing.mode == AntiAliasing::Mode::ssaa;
    const bool msaa = antiAliasing.mode == AntiAliasing::Mode::msaa;
    EXPECT_EQ(layout.scale, ssaa ? antiAliasing.count : 1);
    EXPECT_EQ(layout.samples, msaa ? antiAliasing.count : 1);
  }
}

// Pictures depend on the layout: changing it changes every picture's last bits.
TEST(Tiles, AreTheDocumentedOnes) {
  const auto heights = [](glm::ivec2 resolution, const AntiAliasing& antiAliasing) {
    const TileLayout layout = tilesFor(resolution, antiAliasing);
    return std::pair(layout.bands.size(), layout.bandHeight);
  };
  // 1024 x 1024 x 4 samples are two bands of 2 Mi.
  EXPECT_EQ(heights({1024, 1024}, antiAliasings[1]), std::pair(std::size_t(2), 512));
  EXPECT_EQ(heights({1024, 1024}, antiAliasings[0]), std::pair(std::size_t(1), 1024));
  // 1080 rows, with at most 1092 per band (2 Mi / 1920): one band.
  EXPECT_EQ(heights({1920, 1080}, antiAliasings[0]), std::pair(std::size_t(1), 1080));
  // With 4 samples at most 273 rows per band: four equal ones of 270.
  EXPECT_EQ(heights({1920, 1080}, antiAliasings[1]), std::pair(std::size_t(4), 270));
}

}  // namespace glint::tiles_test
