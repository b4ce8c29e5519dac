// The mip levels of a normal map store how far the normals spread.

#include "glint/render/normal_lengths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "glint/image/mipmaps.h"
#include "glint/shading/specular_filter.h"
#include "gltf_sample.h"
#include "textures.h"

namespace glint {
namespace normal_lengths_test {

/// A normal map with known codes.
DecodedImage mapOf(int width, int height, const std::function<glm::ivec4(int x, int y)>& code) {
  DecodedImage decoded{{width, height, 4, {}}, {}, false};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int k = 0; k < 4; ++k) decoded.image.values.push_back(std::uint8_t(code(x, y)[k]));
  decoded.mipLevels = mipLevels(decoded.image, true);
  return decoded;
}

// Slopes to either side by the same angle: the length of their mean is its cosine.
TEST(NormalLengths, OfTwoSlopesAreTheCosine) {
  for (const int across : {1, 5, 20, 60, 110}) {
    const int up = int(std::lround(std::sqrt(127.5 * 127.5 - across * across)));
    const auto code = [&](int x, int) {
      return glm::ivec4(x % 2 == 0 ? 128 + across : 127 - across, 128, 128 + up, 7);
    };
    DecodedImage map = mapOf(32, 16, code);
    const std::vector<ByteImage> before = map.mipLevels;
    writeNormalLengths(map);
    // 2 texel - 1 in 255ths: +-(2 across + 1), 1, 2 up + 1.
    const double x = 2 * across + 1, y = 1, z = 2 * up + 1;
    const double length = std::hypot(y, z) / std::hypot(x, y, z);
    const double width = std::sqrt((1 - length) / length);
    for (std::size_t i = 3; i < map.image.values.size(); i += 4)
      ASSERT_EQ(map.image.values[i], 255);  // a single normal has no spread
    for (std::size_t k = 0; k < map.mipLevels.size(); ++k)
      for (std::size_t i = 0; i < map.mipLevels[k].values.size(); ++i) {
        if (i % 4 != 3)
          ASSERT_EQ(map.mipLevels[k].values[i], before[k].values[i]);
        else
          ASSERT_NEAR(map.mipLevels[k].values[i], 255 - 255 * width, 0.5 + 1e-3) << across;
      }
  }
}

// Each level size has its own weights: equal normals have no spread at any size, and normals in all
// directions have the full one.
TEST(NormalLengths, OfTheSameNormalsAreOne) {
  for (const glm::ivec2 size : {glm::ivec2(1, 1), {7, 1}, {33, 57}, {640, 3}, {1021, 1019}}) {
    DecodedImage map = mapOf(size.x, size.y, [](int, int) { return glm::ivec4(128, 128, 255, 0); });
    writeNormalLengths(map);
    for (const ByteImage& level : map.mipLevels)
      for (std::size_t i = 3; i < level.values.size(); i += 4) ASSERT_EQ(level.values[i], 255);
  }
  DecodedImage any = mapOf(8, 8, [](int x, int) { return glm::ivec4(x % 2 * 255, 128, 128, 0); });
  writeNormalLengths(any);
  EXPECT_EQ(any.mipLevels.back().values[3], 0);
}

TEST(NormalLengths, CodesAreTheNearest) {
  EXPECT_EQ(normalSpreadCode(1), 255);
  EXPECT_EQ(normalSpreadCode(1.0000001), 255);
  EXPECT_EQ(normalSpreadCode(0.5), 0);
  EXPECT_EQ(normalSpreadCode(0), 0);
  EXPECT_EQ(normalSpreadCode(std::nan("")), 0);
  for (int code = 1; code < 256; ++code) {
    const double variance = std::pow((255 - code) / 255.0, 2);
    EXPECT_EQ(normalSpreadCode(1 / (1 + variance)), code);
  }
  // The smallest spread that differs from none: the variance of an exponent of 65,000.
  EXPECT_NEAR(1 / std::pow(1 / 255.0, 2), 65025, 1);
}

// A look without the filter gets the usual levels.
TEST(NormalLengths, AreMadeWhereTheLookAsksForThem) {
  Scene scene;
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.normals.assign(3, {0, 0, 1});
  mesh.tangents.assign(3, {1, 0, 0, 1});
  mesh.texcoords = {{{0, 0}, {1, 0}, {0, 1}}};
  mesh.indices = {0, 1, 2};
  scene.meshes = {mesh};
  scene.instances = {{0, glm::dmat4(1)}};
  scene.materials.resize(1);
  scene.materials[0].shading.specular = 1;
  scene.materials[0].normalTexture = Texture{};
  scene.images.push_back(
      {"bumps",
       test::png(4, 4, [](int x, int) { return glm::ivec4(60 + 135 * (x % 2), 128, 230, 9); }),
       true,
       {},
       true});
  Look look;
  const auto alphas = [&](SpecularAntialiasing filter) {
    look.specularAntialiasing = filter;
    const DecodedImages images = decodeImages(scene, look);
    const DecodedImage& map = images.at(0);
    EXPECT_EQ(map.hasNormalLengths, filter == SpecularAntialiasing::toksvig);
    return std::pair(map.image.values[3], map.mipLevels.at(0).values[3]);
  };
  EXPECT_EQ(alphas(SpecularAntialiasing::none), std::pair(std::uint8_t(9), std::uint8_t(9)));
  EXPECT_EQ(alphas(SpecularAntialiasing::kaplanyan), std::pair(std::uint8_t(9), std::uint8_t(9)));
  const auto [base, level] = alphas(SpecularAntialiasing::toksvig);
  EXPECT_EQ(base, 255);
  EXPECT_LT(level, 150);
  // If a look changes, only maps without lengths are decoded again.
  const auto again = [&](bool lengths) {
    return decodeImages(scene, look, [&](int, bool needs) { return lengths >= needs; }).size();
  };
  EXPECT_EQ(again(false), 1u);
  EXPECT_EQ(again(true), 0u);
  look.specularAntialiasing = SpecularAntialiasing::none;
  EXPECT_EQ(again(false), 0u);
}

// a / (1 + 4 a v) for Phong, n / (1 + n v) for Blinn-Phong. The total light of the lobe,
// 2 pi / (a + 1), is unchanged.
TEST(NormalLengths, WidenTheLobe) {
  for (const double n : {0.0, 1.0, 20.0, 400.0, 1e6})
    for (const double v : {0.0, 1e-5, 0.01, 1.0}) {
      const FilteredLobe blinn = toksvigLobe(n, true, v), phong = toksvigLobe(n / 4, false, v);
      EXPECT_NEAR(blinn.exponent, n / (1 + n * v), 1e-9 * n);
      EXPECT_NEAR(4 * phong.exponent, blinn.exponent, 1e-9 * n);
      for (const auto& [from, lobe] : {std::pair(n, blinn), std::pair(n / 4, phong)})
        EXPECT_NEAR(lobe.scale / (lobe.exponent + 1), 1 / (from + 1), 1e-12);
    }
  for (const double n : {-1.0, std::nan(""), HUGE_VAL, 40.0})
    for (const double v : {-1.0, std::nan(""), HUGE_VAL, 1.0}) {
      const FilteredLobe f = toksvigLobe(n, false, v);
      EXPECT_TRUE(f.exponent >= 0 && f.exponent <= 1e9) << n << " " << v;
      EXPECT_TRUE(f.scale > 0 && f.scale <= 1) << n << " " << v;
    }
}

}  // namespace normal_lengths_test
}  // namespace glint
