// Environment pictures: the lookup of a direction, and the mip levels.
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <random>

#include "files.h"
#include "glint/image/error.h"
#include "glint/render/environment_image.h"
#include "gltf_text.h"
#include "pictures.h"

namespace glint::test::environment_image_test {

constexpr double pi = std::numbers::pi;

EnvironmentImage::Level makeLevel(int width, int height, auto value) {
  EnvironmentImage::Level level{width, height, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c) level.rgb.push_back(float(value(x, y, c)));
  return level;
}

EnvironmentImage imageOf(int width, int height, auto value) {
  return makeEnvironmentImage(width, height, makeLevel(width, height, value).rgb);
}

// The columns of an 8 x 4 picture, by the directions of their centres: -Z is between 3 and 4, +X
// between 5 and 6, +Z at the seam.
TEST(EnvironmentImage, DirectionsAreFoundWhereTheyBelong) {
  const EnvironmentImage image = imageOf(8, 4, [](int x, int y, int) { return 10 * y + x; });
  const auto at = [&](double turn, double down) {
    return image
        .radiance(
            {std::sin(down) * std::sin(turn), std::cos(down), -std::sin(down) * std::cos(turn)}, 0)
        .x;
  };
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 8; ++x)
      EXPECT_NEAR(at(2 * pi * ((x + 0.5) / 8 - 0.5), pi * (y + 0.5) / 4), 10 * y + x, 1e-12);
  EXPECT_NEAR(image.radiance({0, 1e-3, -1}, 0).x, 15 + 3.5, 0.02);
  EXPECT_NEAR(image.radiance({5, 0, 0}, 0).x, 15 + 5.5, 1e-9);
  EXPECT_NEAR(image.radiance({0, 0, 1}, 0).x, 15 + 3.5, 1e-9);  // the mean of columns 0 and 7
}

TEST(EnvironmentImage, LevelsKeepTheLightAndAUniformPicture) {
  std::mt19937 random(1);
  for (const auto& [width, height] : {std::pair(64, 32), {50, 31}, {7, 5}, {1, 1}, {96, 16}}) {
    std::uniform_real_distribution<double> number(0, 4);
    const EnvironmentImage image =
        imageOf(width, height, [&](int, int, int) { return number(random); });
    const EnvironmentImage even = imageOf(width, height, [](int, int, int) { return 0.7; });
    const auto mean = [](const EnvironmentImage::Level& level) {
      double sum = 0, area = 0;
      for (int y = 0; y < level.height; ++y)
        for (int x = 0; x < level.width; ++x) {
          const double weight = std::sin(pi * (y + 0.5) / level.height);
          sum += weight * level.rgb[std::size_t(3 * (y * level.width + x))];
          area += weight;
        }
      return sum / area;
    };
    EXPECT_EQ(image.levels.back().width * image.levels.back().height, 1);
    for (std::size_t k = 1; k < image.levels.size(); ++k) {
      // The weights are those of row centres; a level with few rows approximates the sine only
      // roughly.
      const double rows = image.levels[k].height;
      EXPECT_NEAR(mean(image.levels[k]), mean(image.levels[0]), 3 / (rows * rows) + 1e-6);
      for (const float v : even.levels[k].rgb) EXPECT_NEAR(v, 0.7, 1e-6);
    }
  }
}

// A radiance that is linear or quadratic in direction, at most 1.
double linearIn(const glm::dvec3& d) { return 0.5 + 0.3 * d.x + 0.35 * d.y - 0.2 * d.z; }
double quadraticIn(const glm::dvec3& d) { return 0.5 + 0.4 * (d.x * d.y + d.z * d.z - d.x * d.z); }

// The mean over a footprint with the variance v along each axis is E + v (E_xx + E_yy) / 2. The
// square of side s has v = s^2 / 12. The mip levels have at most 1.27 s^2 / 9 (h^2 / 3 between
// texels of the height h = s / sqrt(3), which blending two levels makes 1.27 times that), which
// gives the distance from the value at the centre. E_xx is at most 0.5 for the linear radiance and
// 4 times 0.7 for the quadratic one. Bilinear interpolation of texels of the height h adds h^2 / 8
// times both second derivatives; near a pole, the widening of a row adds 0.35 h^2 for the quadratic
// radiance.
TEST(EnvironmentImage, IsTrueOfWhatIsLinearOrQuadraticInDirection) {
  constexpr int height = 128;
  constexpr double h = pi / height;
  for (const bool isLinear : {true, false}) {
    const auto truth = isLinear ? linearIn : quadraticIn;
    const double bend = isLinear ? 0.5 : 2.8;
    const EnvironmentImage image = imageOf(2 * height, height, [&](int x, int y, int) {
      const double down = pi * (y + 0.5) / height, turn = pi * ((x + 0.5) / height - 1);
      return truth(
          {std::sin(down) * std::sin(turn), std::cos(down), -std::sin(down) * std::cos(turn)});
    });
    double worst = 0;
    for (const double spread : {0.0, 0.01, 0.05, 0.07, 0.1, 0.2, 0.4})
      for (int i = 0; i <= 400; ++i)
        for (const double turn : {0.0, 0.3, 1.0, 1.6, 2.9, pi, -3.1, -2.0, -0.7}) {
          // Through both poles and close around them; at `turn` = pi along the seam.
          const double down = i < 200 ? pi * i / 199 : (i % 2 ? 0.0 : pi) + 0.002 * (i - 300);
          const glm::dvec3 d(std::sin(down) * std::sin(turn), std::cos(down),
                             -std::sin(down) * std::cos(turn));
          const double got = image.radiance(d, spread).x;
          const double bound = bend * (1.27 * spread * spread / 9 + h * h / 4) +
                               (isLinear ? 0.0 : 0.35 * 4 * spread * spread / 3) + 1e-6;
          worst = std::max(worst, std::abs(got - truth(d)) / bound);
          ASSERT_LE(std::abs(got - truth(d)), bound)
              << "spread " << spread << " down " << down << " turn " << turn;
        }
    EXPECT_GT(worst, 0.1);
  }
}

// The level rule: averaged over all directions, the mean over a square is met to a quarter of its
// difference from the value at the centre. The factors are 1 - s^2 / 12 for a linear radiance about
// its mean, and 1 - s^2 / 4 for the quadratic part.
TEST(EnvironmentImage, LevelsHaveTheVarianceOfThePixel) {
  constexpr int height = 256;
  const EnvironmentImage image = imageOf(2 * height, height, [&](int x, int y, int) {
    const double down = pi * (y + 0.5) / height, turn = pi * ((x + 0.5) / height - 1);
    return linearIn(
        {std::sin(down) * std::sin(turn), std::cos(down), -std::sin(down) * std::cos(turn)});
  });
  for (const double level : {2.0, 3.0, 4.0}) {  // whole levels, where only one is looked up
    const double s = std::sqrt(3) * pi / height * std::exp2(level);
    double got = 0, wanted = 0;
    std::mt19937 random(5);
    std::uniform_real_distribution<double> number(-1, 1);
    for (int i = 0; i < 20000;) {
      const glm::dvec3 v(number(random), number(random), number(random));
      if (!(glm::length(v) < 1) || glm::length(v) < 0.1) continue;
      ++i;
      const double e = linearIn(glm::normalize(v)) - 0.5;
      got += e * (image.radiance(v, s).x - 0.5 - e);
      wanted += e * (-s * s / 12 * e);
    }
    EXPECT_NEAR(got / wanted, 1, 0.25) << level;
  }
}

TEST(EnvironmentImage, APoleIsSmoothFromTheFirstSmallerLevelOn) {
  std::mt19937 random(2);
  const EnvironmentImage image =
      imageOf(128, 64, [&](int, int, int) { return double(random() % 2); });
  const double spread = 2 * std::numbers::sqrt3 * pi / 64;  // level 1
  EXPECT_NEAR(image.levelFor(spread), 1, 1e-12);
  const double there = image.radiance({1e-9, 1, 0}, spread).x;
  for (int i = 1; i < 16; ++i)
    EXPECT_NEAR(image.radiance({1e-9 * std::cos(i), 1, 1e-9 * std::sin(i)}, spread).x, there, 1e-6);
}

TEST(EnvironmentImage, LevelsGoFromTheFullSizeToOneTexel) {
  const EnvironmentImage image = imageOf(32, 16, [](int x, int, int) { return x; });
  EXPECT_EQ(image.levelFor(0), 0);
  EXPECT_EQ(image.levelFor(1e-9), 0);
  EXPECT_EQ(image.levelFor(100), double(image.levels.size() - 1));
  EXPECT_NEAR(image.radiance({1, 2, 3}, 100).x, 15.5, 1e-5);
}

TEST(EnvironmentImage, WhatIsNoRadianceCountsAsNone) {
  const float values[] = {-1, std::nanf(""), INFINITY, 2, 3, 4};
  const EnvironmentImage image = makeEnvironmentImage(2, 1, {std::begin(values), std::end(values)});
  EXPECT_EQ(image.levels[0].rgb, (std::vector<float>{0, 0, 1e30f, 2, 3, 4}));
  EXPECT_EQ(image.corrected, 1u);  // texels, not values
}

TEST(EnvironmentImage, IsReadOnceAndOnlyWhereItShows) {
  const std::string file = glint::test::temporaryFolder() + "/env.pfm";
  writePicture(file, {2, 1, {1, 2, 3, 1, 4, 5, 6, 1}});
  glint::Look look;
  look.hdriFile = file;
  EXPECT_EQ(environmentImageFor(look), nullptr);
  look.environmentBackground = true;
  const auto image = environmentImageFor(look);
  ASSERT_NE(image, nullptr);
  EXPECT_EQ(image->levels[0].rgb, (std::vector<float>{1, 2, 3, 4, 5, 6}));
  look.shading = glint::Shading::environment;
  EXPECT_EQ(environmentImageFor(look), image);
  look.hdriFile = glint::test::temporaryFolder() + "/none.hdr";
  EXPECT_THAT(messageOf([&] { environmentImageFor(look); }), testing::StartsWith("--hdri-file: "));
}

}  // namespace glint::test::environment_image_test
