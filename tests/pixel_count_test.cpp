// Counts of differing pixels, compared with pixelmatch and closed cases.

#include <gmock/gmock.h>

#include <cmath>
#include <functional>

#include "code_pictures.h"
#include "glint/image/compare.h"

namespace glint::test::pixel_count_test {

using testing::ElementsAre;

/// An anti-aliased disc, from 4 x 4 samples; centre and radius in eighths of a pixel. `grain` of
/// every seven pixels are slightly brighter.
StoredImage disc(int cx, int cy, int grain) {
  return codes(48, 48, 3, [=](int x, int y) {
    int covered = 0;
    for (int j = 0; j < 4; ++j)
      for (int i = 0; i < 4; ++i) {
        const int dx = 8 * x + 2 * i + 1 - cx, dy = 8 * y + 2 * j + 1 - cy;
        covered += dx * dx + dy * dy < 120 * 120;
      }
    const int more = (3 * x * x + 5 * y + x * y) % 7 < grain ? 9 : 0;
    return std::vector<int>{40 + covered * 180 / 16 + more, 200 - covered * 150 / 16,
                            30 + covered * 60 / 16};
  });
}

struct Counted {
  int cx, cy, grain;
  struct {
    double tolerance;
    int over, withoutAntiAliased;
  } counts[4];
};

void expectCounts(std::initializer_list<Counted> cases, PixelDistance distance) {
  const StoredImage a = disc(190, 190, 0);
  for (const Counted& c : cases) {
    const StoredImage b = disc(c.cx, c.cy, c.grain);
    for (const auto& [tolerance, over, without] : c.counts) {
      CompareOptions options;
      options.metrics = {"pixels"};
      options.distance = distance;
      options.tolerance = tolerance;
      EXPECT_EQ(compare(a, b, options).values.at("pixels"), over) << c.cx << ", " << tolerance;
      options.ignoreAntiAliasing = true;
      const Comparison result = compare(a, b, options);
      EXPECT_EQ(result.values.at("pixels"), without) << c.cx << ", " << tolerance;
      EXPECT_EQ(result.antiAliased, std::size_t(over - without));
    }
  }
}

// Counted by the program itself, version 7.2.0:
// pixelmatch(a, b, null, 48, 48, {threshold, includeAA}).
TEST(PixelCount, AsPixelmatch7) {
  expectCounts({{192, 191, 0, {{0, 96, 0}, {0.02, 96, 0}, {0.1, 37, 0}, {0.3, 0, 0}}},
                {194, 190, 0, {{0, 120, 0}, {0.02, 120, 0}, {0.1, 64, 0}, {0.3, 0, 0}}},
                {199, 203, 0, {{0, 212, 45}, {0.02, 212, 45}, {0.1, 166, 45}, {0.3, 101, 45}}},
                {230, 190, 0, {{0, 392, 212}, {0.02, 392, 212}, {0.1, 349, 212}, {0.3, 286, 212}}},
                {194, 190, 1, {{0, 393, 271}, {0.02, 120, 10}, {0.1, 65, 7}, {0.3, 0, 0}}},
                {199, 203, 3, {{0, 976, 863}, {0.02, 212, 108}, {0.1, 166, 87}, {0.3, 101, 66}}}},
               PixelDistance::yiq);
}

// Counted by version 8.0.0.
TEST(PixelCount, AsPixelmatch8) {
  expectCounts(
      {{192, 191, 0, {{0.02, 96, 0}, {0.05, 70, 0}, {0.1, 50, 0}, {0.3, 0, 0}}},
       {194, 190, 0, {{0.02, 120, 0}, {0.05, 100, 0}, {0.1, 78, 0}, {0.3, 8, 0}}},
       {199, 203, 0, {{0.02, 212, 45}, {0.05, 195, 45}, {0.1, 177, 45}, {0.3, 101, 45}}},
       {230, 190, 0, {{0.02, 392, 212}, {0.05, 377, 212}, {0.1, 359, 212}, {0.3, 290, 212}}},
       {194, 190, 1, {{0.02, 199, 78}, {0.05, 100, 9}, {0.1, 78, 8}, {0.3, 8, 0}}},
       {199, 203, 3, {{0.02, 428, 315}, {0.05, 195, 99}, {0.1, 175, 92}, {0.3, 101, 66}}}},
      PixelDistance::oklab);
}

// The largest threshold at which 8.0.0 counts a pixel, found by bisection. It interpolates cube
// roots linearly between 4096 steps, which is off by h^2 / 8 (2 / 9) x^(-5/3): by 3e-5 for the dark
// grey (x = 0.003), where lightness has a slope below 1, and by less than 1e-6 elsewhere.
TEST(PixelCount, DistancesOfPixelmatch8) {
  struct Case {
    std::vector<int> a, b;
    double distance, error = 1e-6;
  };
  const Case cases[] = {{{0, 0, 0}, {255, 255, 255}, 1.0},
                        {{0, 255, 0}, {0, 0, 255}, 1.00870028},
                        {{10, 10, 10}, {12, 12, 12}, 0.00670438480, 6e-5},
                        {{200, 30, 40}, {198, 33, 41}, 0.00571731365},
                        {{0, 0, 0}, {0, 0, 8}, 0.0564052933},
                        {{255, 0, 0}, {0, 255, 255}, 0.730923103}};
  for (const Case& c : cases) {
    CompareOptions options;
    options.metrics = {"pixels"};
    options.distance = PixelDistance::oklab;
    for (const int side : {-1, 1}) {
      options.tolerance = c.distance + side * c.error;
      EXPECT_EQ(compare(plain(1, 1, c.a), plain(1, 1, c.b), options).values.at("pixels"),
                side < 0 ? 1 : 0)
          << c.distance;
    }
  }
}

// Counted by version 8.0.0 with windowSize, threshold 0.1.
TEST(PixelCount, WindowsOfPixelmatch8) {
  struct Case {
    int cx, cy, grain;
    struct {
      int side, over, withoutAntiAliased;
    } counts[5];
  };
  const Case cases[] = {
      {194, 190, 0, {{1, 1, 0}, {4, 8, 0}, {8, 13, 0}, {16, 24, 0}, {47, 78, 0}}},
      {199, 203, 0, {{1, 1, 1}, {4, 12, 4}, {8, 26, 9}, {16, 56, 21}, {47, 177, 45}}},
      {199, 203, 3, {{1, 1, 1}, {4, 12, 8}, {8, 26, 14}, {16, 55, 31}, {47, 175, 92}}}};
  const StoredImage a = disc(190, 190, 0);
  for (const Case& c : cases) {
    const StoredImage b = disc(c.cx, c.cy, c.grain);
    for (const auto& [side, over, without] : c.counts)
      for (const bool ignore : {false, true}) {
        CompareOptions options;
        options.metrics = {"pixels"};
        options.distance = PixelDistance::oklab;
        options.window = side;
        options.ignoreAntiAliasing = ignore;
        EXPECT_EQ(compare(a, b, options).values.at("pixels"), ignore ? without : over)
            << c.cx << ", " << side;
      }
  }
}

TEST(PixelCount, NumberAndShareAllowed) {
  const StoredImage a = plain(10, 10, {0, 0, 0});
  const StoredImage b = codes(10, 10, 3, [](int x, int y) {
    return x == 0 && y < 3 ? std::vector<int>{255, 255, 255} : std::vector<int>{1, 1, 1};
  });
  CompareOptions options;
  options.maxPixels = {{3}};
  EXPECT_TRUE(compare(a, b, options).same);
  options.maxPixels = {{2}};
  EXPECT_THAT(compare(a, b, options).failures,
              ElementsAre("3 pixels are over the tolerance of 0.1, the limit is 2"));
  options.maxPixels = {{0.03, true}};
  EXPECT_TRUE(compare(a, b, options).same);
  options.maxPixels = {{0.0299, true}};
  EXPECT_FALSE(compare(a, b, options).same);
  // The distance between black and white is the root of 0.5053 * 255^2 / 35215 = 0.96592.
  options.maxPixels = {{0, true}};
  options.tolerance = 0.9659;
  EXPECT_FALSE(compare(a, b, options).same);
  options.tolerance = 0.966;
  EXPECT_TRUE(compare(a, b, options).same);
}

}  // namespace glint::test::pixel_count_test
