// Texture sampling of the reference compared with values computed by hand.

#include "glint/reference/texture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "glint/image/mipmaps.h"
#include "reference_scenes.h"

namespace glint::reference_texture_test {

using namespace scenes;
using glint::reference::TextureSampler;

// The sRGB curve by its definition.
double linear(int code) {
  const double s = code / 255.0;
  return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
}

// One or more rows of grey texels; alpha is 255 minus the code.
ByteImage grey(int width, std::vector<int> codes) {
  ByteImage image;
  image.width = width;
  image.height = int(codes.size()) / width;
  for (int c : codes)
    for (int v : {c, c, c, 255 - c}) image.values.push_back(std::uint8_t(v));
  return image;
}

Sampler sampler(Filter filter, Wrap wrap, MipFilter mip = MipFilter::none) {
  return {filter, filter, mip, wrap, wrap};
}

// Codes decode to floats: an error of half an ulp.
constexpr double decoding = 3e-8;

TEST(ReferenceTexture, CoordinatesBeyondAllBoundsGiveSomeTexel) {
  const ByteImage image = grey(4, {10, 60, 120, 250});
  const double inf = std::numeric_limits<double>::infinity();
  for (const Filter filter : {Filter::nearest, Filter::linear})
    for (const Wrap wrap : {Wrap::repeat, Wrap::mirroredRepeat, Wrap::clampToEdge})
      for (const double u : {1e300, 1e308, std::numeric_limits<double>::max(), inf, std::nan("")})
        for (const glm::dvec2 at : {glm::dvec2(u, 0.5), glm::dvec2(-u, 0.5), glm::dvec2(0.5, u)}) {
          const double red = TextureSampler(image, {}, sampler(filter, wrap)).sampleLevel(at, 0).r;
          EXPECT_TRUE(red >= linear(10) - decoding && red <= linear(250) + decoding) << u;
        }
}

TEST(ReferenceTexture, NearestTexelUnderEveryWrap) {
  const ByteImage image = grey(4, {10, 60, 120, 250});
  const auto at = [&](Wrap wrap, double u) {
    return TextureSampler(image, {}, sampler(Filter::nearest, wrap)).sampleLevel({u, 0.5}, 0).r;
  };
  struct Case {
    double u;
    int repeat, mirrored, clamped;
  };
  for (const Case& c : {Case{0.1, 10, 10, 10},
                        {0.3, 60, 60, 60},
                        {0.99, 250, 250, 250},
                        {1.1, 10, 250, 250},
                        {1.3, 60, 120, 250},
                        {1.99, 250, 10, 250},
                        {2.1, 10, 10, 250},
                        {-0.1, 250, 10, 10},
                        {-0.3, 120, 60, 10},
                        {-1.1, 250, 250, 10},
                        {-7.3, 120, 120, 10},
                        {1e6 + 0.3, 60, 60, 250}}) {
    EXPECT_NEAR(at(Wrap::repeat, c.u), linear(c.repeat), decoding) << c.u;
    EXPECT_NEAR(at(Wrap::mirroredRepeat, c.u), linear(c.mirrored), decoding) << c.u;
    EXPECT_NEAR(at(Wrap::clampToEdge, c.u), linear(c.clamped), decoding) << c.u;
  }
}

TEST(ReferenceTexture, LinearFilterInLinearLight) {
  const ByteImage image = grey(2, {0, 255, 128, 40});
  const TextureSampler clamped(image, {}, sampler(Filter::linear, Wrap::clampToEdge));
  const TextureSampler repeated(image, {}, sampler(Filter::linear, Wrap::repeat));
  const double a = linear(0), b = linear(255), c = linear(128), d = linear(40);
  // Texel centres at 1/4 and 3/4.
  EXPECT_NEAR(clamped.sampleLevel({0.25, 0.25}, 0).r, a, decoding);
  EXPECT_NEAR(clamped.sampleLevel({0.5, 0.25}, 0).r, (a + b) / 2, decoding);
  EXPECT_NEAR(clamped.sampleLevel({0.5, 0.5}, 0).r, (a + b + c + d) / 4, decoding);
  EXPECT_NEAR(clamped.sampleLevel({0.4, 0.65}, 0).r,
              0.2 * (0.7 * a + 0.3 * b) + 0.8 * (0.7 * c + 0.3 * d), decoding);
  EXPECT_NEAR(clamped.sampleLevel({0, 0.25}, 0).r, a, decoding);
  EXPECT_NEAR(repeated.sampleLevel({0, 0.25}, 0).r, (a + b) / 2, decoding);
  EXPECT_NEAR(repeated.sampleLevel({0.25, 1}, 0).r, (a + c) / 2, decoding);
  EXPECT_NEAR(clamped.sampleLevel({0.4, 0.25}, 0).a, 0.7 * 1 + 0.3 * 0, 1e-15);
}

TEST(ReferenceTexture, LevelsOfDetail) {
  const ByteImage base = grey(4, std::vector<int>(16, 10));
  const std::vector<ByteImage> smaller = {grey(2, std::vector<int>(4, 100)), grey(1, {200})};
  const double l0 = linear(10), l1 = linear(100), l2 = linear(200);
  const auto at = [&](MipFilter mip, double lod) {
    return TextureSampler(base, smaller, sampler(Filter::linear, Wrap::repeat, mip))
        .sampleLevel({0.3, 0.7}, lod)
        .r;
  };
  for (const double lod : {-3.0, 0.0, 0.5}) EXPECT_NEAR(at(MipFilter::nearest, lod), l0, decoding);
  EXPECT_NEAR(at(MipFilter::nearest, 0.51), l1, decoding);
  EXPECT_NEAR(at(MipFilter::nearest, 1.5), l1, decoding);
  EXPECT_NEAR(at(MipFilter::nearest, 9), l2, decoding);
  EXPECT_NEAR(at(MipFilter::linear, 0.25), 0.75 * l0 + 0.25 * l1, decoding);
  EXPECT_NEAR(at(MipFilter::linear, 1.75), 0.25 * l1 + 0.75 * l2, decoding);
  EXPECT_NEAR(at(MipFilter::linear, 7), l2, decoding);
  EXPECT_NEAR(at(MipFilter::none, 7), l0, decoding);
  // The longer axis of the footprint decides, in texels: 3 across, 8 along.
  const TextureSampler trilinear(base, smaller,
                                 sampler(Filter::linear, Wrap::repeat, MipFilter::linear));
  EXPECT_NEAR(trilinear.sample({0.3, 0.7}, {{0.5, 0}, {0, 0.75}}).r,
              (1 - std::log2(1.5)) * l1 + std::log2(1.5) * l2, decoding);
  EXPECT_NEAR(trilinear.sample({0.3, 0.7}, {{0.3, 0.4}, {0, 0}}).r, l1, decoding);
}

// Each texel of the next level is the mean over the area that it covers, also for odd sizes: of
// three texels, one texel covers all.
TEST(ReferenceTexture, OddSizesAreMeansOverArea) {
  const auto levels = glint::mipLevels(grey(3, {0, 120, 250, 40, 90, 130, 200, 220, 255}));
  ASSERT_EQ(levels.size(), 1u);
  double mean = 0;
  for (int c : {0, 120, 250, 40, 90, 130, 200, 220, 255}) mean += linear(c) / 9;
  const double low = linear(levels[0].values[0] - 1), high = linear(levels[0].values[0] + 1);
  EXPECT_TRUE(low < mean && mean < high);
}

// The whole pyramid compared with means computed from the full size in double: a code is that of
// the exact mean, or next to it where rounding decides.
TEST(ReferenceTexture, LevelsAreMeansOfTheFullSize) {
  constexpr int width = 24, height = 10;  // 24 to 12, 6, 3 and 1; 10 to 5, 2 and 1
  std::vector<int> codes;
  for (int i = 0; i < width * height; ++i) codes.push_back(i * i * 37 % 256);
  const ByteImage base = grey(width, codes);
  for (const bool isData : {false, true}) {
    const auto levels = glint::mipLevels(base, isData);
    ASSERT_EQ(levels.size(), 4u);
    std::vector<double> values[2];  // of the previous level: colour and alpha
    for (const int c : codes) {
      values[0].push_back(isData ? c / 255.0 : linear(c));
      values[1].push_back((255 - c) / 255.0);
    }
    int w = width, h = height;
    for (const ByteImage& level : levels) {
      ASSERT_EQ(level.width, std::max(1, w / 2));
      ASSERT_EQ(level.height, std::max(1, h / 2));
      const double stepX = double(w) / level.width, stepY = double(h) / level.height;
      for (int channel = 0; channel < 2; ++channel) {
        std::vector<double> next;
        for (int y = 0; y < level.height; ++y)
          for (int x = 0; x < level.width; ++x) {
            double sum = 0;
            for (int j = 0; j < h; ++j)
              for (int i = 0; i < w; ++i)
                sum += values[channel][std::size_t(j * w + i)] *
                       std::max(0.0,
                                std::min(i + 1.0, (x + 1) * stepX) - std::max(i + 0.0, x * stepX)) *
                       std::max(0.0,
                                std::min(j + 1.0, (y + 1) * stepY) - std::max(j + 0.0, y * stepY));
            next.push_back(sum / stepX / stepY);
            const int code =
                level.values[std::size_t(4) * std::size_t(y * level.width + x) + (channel ? 3 : 0)];
            const bool curved = channel == 0 && !isData;
            const auto valueOf = [&](double c) {
              const double s = c / 255;
              return !curved ? s : s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
            };
            EXPECT_LT(valueOf(code - 0.5) - 1e-6, next.back());
            EXPECT_GT(valueOf(code + 0.5) + 1e-6, next.back());
          }
        values[channel] = std::move(next);
      }
      w = level.width;
      h = level.height;
    }
  }
}

// A receding plane: the texture's footprint is the largest step of the perspective coordinates
// within the square of 2 x 2 pixels, here for a floor: u = right * distance, v = distance.
TEST(ReferenceTexture, FootprintsInPerspective) {
  glint::Material floor;
  floor.unlit = floor.doubleSided = true;
  floor.colorTexture = glint::Texture{};
  Mesh mesh = triangles({{-40, -1, 0}, {40, -1, 0}, {0, -1, -40}});
  mesh.texcoords = {{{-40, 0}, {40, 0}, {0, 40}}};
  Scene scene = sceneOf({{mesh, floor}});
  scene.images.emplace_back();
  // A chain of uniform levels: the colour depends only on the level of detail.
  glint::DecodedImages images;
  images[0].image = grey(16, std::vector<int>(256, 0));
  const int codes[] = {60, 120, 180, 240};
  for (int i = 0; i < 4; ++i)
    images[0].mipLevels.push_back(
        grey(8 >> i, std::vector<int>(std::size_t(64 >> (2 * i)), codes[i])));
  const double values[] = {0, linear(60), linear(120), linear(180), linear(240)};
  const int size = 128;
  Look look = plainLook(size, size);
  look.noBackground = true;
  lookFromOrigin(scene, look, 1, 0.01, 100);
  const auto image = draw(scene, look, images);
  int compared = 0;
  for (int y = size / 2 + 4; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      if (pixel(image, x, y).a == 0) continue;
      const double right = 2 * (x + 0.5) / size - 1, up = 1 - 2 * (y + 0.5) / size;
      const double step = 2.0 / size;
      const double otherRight = x % 2 ? right - step : right + step;
      const double otherUp = y % 2 ? up + step : up - step;  // the number of rows is even
      const auto place = [](double r, double u) { return glm::dvec2(-r / u, -1 / u); };
      double most = 0;
      for (const double u : {up, otherUp})
        most = std::max(most, glm::length(place(otherRight, u) - place(right, u)));
      for (const double r : {right, otherRight})
        most = std::max(most, glm::length(place(r, otherUp) - place(r, up)));
      const double lod = std::clamp(std::log2(16 * most), 0.0, 4.0);
      const int level = std::min(int(lod), 3);
      const double t = lod - level;
      ++compared;
      ASSERT_NEAR(pixel(image, x, y).r, (1 - t) * values[level] + t * values[level + 1], 2e-7)
          << x << "," << y;
    }
  EXPECT_GT(compared, 2000);
}

TEST(ReferenceTexture, MasksDiscard) {
  glint::Material leaf;
  leaf.unlit = true;
  leaf.colorTexture = glint::Texture{0, 0, sampler(Filter::nearest, Wrap::repeat)};
  leaf.alphaMode = glint::AlphaMode::mask;
  leaf.alphaCutoff = 0.5;
  Mesh mesh = rectangle({-2, -2}, {2, 2});
  mesh.texcoords = {{{0, 1}, {1, 1}, {1, 0}, {0, 0}}};
  Scene scene = sceneOf({{mesh, leaf}});
  scene.images.emplace_back();
  glint::DecodedImages images;
  images[0].image = grey(2, {0, 255, 250, 60});  // alpha 255, 0, 5, 195: rows from the top
  Look look = plainLook(4, 4);
  look.noBackground = true;
  lookAlongZ(scene, look, 2);
  const auto image = draw(scene, look, images);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x)
      EXPECT_EQ(pixel(image, x, y).a, (x < 2) == (y < 2)) << x << "," << y;
}

TEST(ReferenceTexture, IsNotReadWithoutCoordinates) {
  glint::Material plain;
  plain.unlit = true;
  plain.shading.color = {0.25, 0.5, 1};
  plain.colorTexture = glint::Texture{};
  Scene scene = sceneOf({{rectangle({-2, -2}, {2, 2}), plain}});
  scene.images.emplace_back();
  Look look = plainLook(4, 4);
  lookAlongZ(scene, look, 2);
  EXPECT_EQ(glm::dvec3(pixel(draw(scene, look), 1, 1)), plain.shading.color);
}

}  // namespace glint::reference_texture_test
