// The metrics of picture comparison, tested against closed cases and other programs.

#include "glint/image/compare.h"
#include "code_pictures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "glint/image/error.h"

namespace glint::test::compare_test {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

StoredImage noise(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  return codes(width, height, 3, [&](int, int) {
    return std::vector<int>{int(random() % 256), int(random() % 256), int(random() % 256)};
  });
}

Image linear(int width, int height, const std::vector<float>& rgba) {
  Image image{width, height, {}};
  for (int i = 0; i < width * height; ++i)
    image.values.insert(image.values.end(), rgba.begin(), rgba.end());
  return image;
}

CompareOptions asking(const std::vector<std::string>& metrics) {
  CompareOptions options;
  options.metrics = metrics;
  return options;
}

TEST(Compare, DifferencesOfValues) {
  // Two pixels of three channels: differences of 51, 0, 0 and 0, 0, 255 codes.
  const StoredImage a = codes(2, 1, 3, [](int x, int) {
    return x == 0 ? std::vector<int>{51, 7, 9} : std::vector<int>{0, 0, 0};
  });
  const StoredImage b = codes(2, 1, 3, [](int x, int) {
    return x == 0 ? std::vector<int>{102, 7, 9} : std::vector<int>{0, 0, 255};
  });
  const Comparison result = compare(a, b);
  EXPECT_FALSE(result.same);
  EXPECT_EQ(result.differing, 2u);
  EXPECT_EQ(result.pixels, 2u);
  EXPECT_NEAR(result.values.at("max"), 1, 1e-7);
  EXPECT_NEAR(result.values.at("mean"), 1.2 / 6, 1e-7);
  EXPECT_NEAR(result.values.at("rmse"), std::sqrt(1.04 / 6), 1e-7);
  EXPECT_NEAR(result.values.at("psnr"), -10 * std::log10(1.04 / 6), 1e-5);
  EXPECT_NEAR(result.values.at("relative-rmse"), std::sqrt((0.04 / (0.04 + 0.01) + 1 / 0.01) / 6),
              1e-5);
  ASSERT_EQ(result.worst.size(), 2u);
  EXPECT_EQ(result.worst[0].x, 1);
  EXPECT_NEAR(result.worst[1].difference, 0.2, 1e-7);
  EXPECT_THAT(result.worstText(), HasSubstr("(1, 0): 0 0 0 1 -> 0 0 1 1, difference 1\n"));
}

TEST(Compare, PeakSignalToNoiseOfOneCode) {
  // The textbook's 20 log10(255) = 48.1308 dB.
  const Comparison result = compare(plain(9, 9, {100, 100, 100}), plain(9, 9, {101, 101, 101}));
  EXPECT_NEAR(result.values.at("psnr"), 48.1308, 1e-4);
}

TEST(Compare, Conditions) {
  const StoredImage a = plain(10, 10, {100, 100, 100}), b = plain(10, 10, {110, 100, 100});
  CompareOptions options;
  options.conditions = {{"max", 0.04}, {"psnr", 30}};
  EXPECT_TRUE(compare(a, b, options).same);
  options.conditions = {{"max", 0.039}, {"psnr", 34}};
  EXPECT_THAT(compare(a, b, options).failures,
              ElementsAre("max 0.0392157 is above 0.039", "psnr 32.902 is below 34"));
  options.conditions = {{"maximum", 1}};
  EXPECT_THROW(compare(a, b, options), glint::InputError);
  EXPECT_TRUE(compare(a, a).same);
  EXPECT_THAT(compare(a, b).failures, ElementsAre("100 pixels differ"));
}

TEST(Compare, SizesThatDiffer) {
  const Comparison result = compare(plain(10, 10, {1, 1, 1}), plain(10, 11, {1, 1, 1}));
  EXPECT_FALSE(result.same);
  EXPECT_THAT(result.failures,
              ElementsAre("the sizes differ: 10 x 10 and 10 x 11 pixels", "10 pixels differ"));
  // The smaller one is padded with transparent pixels: of 440 values the 10 of alpha are off by 1,
  // the 30 of colour by 1/255.
  EXPECT_NEAR(result.values.at("max"), 1, 0);
  EXPECT_NEAR(result.values.at("mean"), (10 + 30 / 255.0) / 440, 1e-9);
}

TEST(Compare, WhatIsNotFiniteFailsUnlessEqualityIsAsked) {
  Image a = linear(3, 1, {0.5f, 0.5f, 0.5f, 1}), b = a;
  a.values[0] = b.values[0] = nan;
  a.values[4] = b.values[4] = infinity;
  EXPECT_TRUE(compare(a, b).same);
  CompareOptions options;
  options.conditions = {{"max", 1e9}};
  const Comparison result = compare(a, b, options);
  EXPECT_FALSE(result.same);
  EXPECT_EQ(result.nanA, 1u);
  EXPECT_EQ(result.nanB, 1u);
  EXPECT_EQ(result.infinityA, 1u);
  EXPECT_EQ(result.infinityB, 1u);
  EXPECT_EQ(result.values.at("max"), 0);
  // Pixels in only one picture differ in every metric, and are the worst.
  b = linear(3, 1, {0.5f, 0.5f, 0.5f, 1});
  b.values[8] = 100;
  const Comparison one = compare(a, b);
  EXPECT_FALSE(one.same);
  EXPECT_EQ(one.worst[0].difference, infinity);
  options.conditions.clear();
  options.maxPixels = {{3}};
  EXPECT_FALSE(compare(a, b, options).same);
  a = linear(3, 1, {0.5f, 0.5f, 0.5f, 1});
  b = a;
  b.values[1] = -infinity;
  EXPECT_THAT(compare(a, b, options).failures,
              ElementsAre("1 pixel is infinite in only one of the two"));
}

TEST(Compare, ValueSpaces) {
  // sRGB 188 is 0.5029 in linear light.
  const StoredImage code = plain(2, 2, {188, 188, 188});
  const Image grey = linear(2, 2, {0.502886f, 0.502886f, 0.502886f, 1});
  const StoredImage light{2, 2, 4, grey.values};
  CompareOptions options;
  EXPECT_THROW(compare(code, light, options), glint::InputError);
  for (const ValueSpace space : {ValueSpace::encoded, ValueSpace::linear}) {
    options.values = space;
    EXPECT_LT(compare(code, light, options).values.at("max"), 1e-6);
    EXPECT_NEAR(compare(code, plain(2, 2, {0, 0, 0}), options).values.at("max"),
                space == ValueSpace::encoded ? 188 / 255.0 : 0.502886, 1e-6);
  }
  // As stored: codes for one kind, linear light for the other.
  EXPECT_EQ(compare(code, code).space, ValueSpace::encoded);
  EXPECT_EQ(compare(light, light).space, ValueSpace::linear);
}

TEST(Compare, AlphaStraightOverAndIgnored) {
  // Invisible colours do not differ. Opaque black and absent pixels do, by every metric, though
  // both look the same over black.
  const StoredImage hidden = plain(20, 20, {9, 200, 30, 0}), other = plain(20, 20, {90, 2, 3, 0});
  const StoredImage black = plain(20, 20, {0, 0, 0, 255});
  EXPECT_TRUE(compare(hidden, other).same);
  const Comparison seen = compare(hidden, black, asking({"pixels", "flip", "ssim"}));
  EXPECT_EQ(seen.values.at("max"), 1);
  EXPECT_EQ(seen.values.at("pixels"), 400);
  EXPECT_GT(seen.values.at("flip"), 0.9);
  EXPECT_LT(seen.values.at("ssim"), 0.01);
  EXPECT_EQ(seen.alphaDiffering, 400u);
  const StoredImage white = plain(20, 20, {255, 255, 255, 255});
  EXPECT_GT(compare(hidden, white, asking({"flip"})).values.at("flip"), 0.9);
  CompareOptions options = asking({"pixels", "flip", "ssim"});
  options.alpha = AlphaUse::over;
  EXPECT_EQ(compare(hidden, black, options).values.at("flip"), 0);
  EXPECT_TRUE(compare(hidden, black, options).same);
  options.background = {1, 1, 1};
  EXPECT_FALSE(compare(hidden, black, options).same);
  EXPECT_TRUE(compare(hidden, white, options).same);
  // Half-covering white over black is half of its light.
  options.background = {0, 0, 0};
  options.values = ValueSpace::linear;
  EXPECT_NEAR(
      compare(plain(2, 2, {255, 255, 255, 51}), plain(2, 2, {0, 0, 0}), options).values.at("max"),
      0.2, 1e-6);
  options.alpha = AlphaUse::ignored;
  EXPECT_TRUE(compare(plain(2, 2, {8, 8, 8, 7}), plain(2, 2, {8, 8, 8, 255}), options).same);
}

TEST(Compare, OpaquePicturesKeepTheirCodes) {
  // An alpha channel of 255 changes nothing, not even by a rounding.
  const StoredImage a = noise(30, 20, 1);
  StoredImage b = a;
  b.channels = 4;
  auto& values = std::get<0>(b.values);
  values.clear();
  for (std::size_t i = 0; i < 600; ++i) {
    const auto* p = &std::get<0>(a.values)[3 * i];
    values.insert(values.end(), {p[0], p[1], p[2], 255});
  }
  CompareOptions options = asking({"pixels", "flip", "ssim"});
  options.tolerance = 0;
  const Comparison result = compare(a, b, options);
  EXPECT_TRUE(result.same);
  EXPECT_EQ(result.values.at("pixels"), 0);
  EXPECT_EQ(result.values.at("flip"), 0);
}

TEST(Compare, IgnoredBoxesAndMasksReachNobody) {
  const StoredImage a = noise(60, 50, 2);
  StoredImage b = a;
  auto& values = std::get<0>(b.values);
  for (int y = 10; y <= 20; ++y)
    for (int x = 5; x <= 15; ++x)
      for (int c = 0; c < 3; ++c) values[std::size_t(3 * (60 * y + x) + c)] ^= 0x80;
  CompareOptions options = asking({"pixels", "flip", "ssim"});
  EXPECT_EQ(compare(a, b, options).differing, 121u);
  options.ignored = {{5, 10, 15, 20}};
  const auto check = [&] {
    const Comparison result = compare(a, b, options);
    EXPECT_TRUE(result.same);
    EXPECT_EQ(result.ignoredPixels, 121u);
    EXPECT_EQ(result.pixels, 60u * 50 - 121);
    for (const char* name : {"max", "pixels", "flip"}) EXPECT_EQ(result.values.at(name), 0) << name;
    EXPECT_EQ(result.values.at("ssim"), 1);
  };
  check();
  options.ignored.clear();
  const StoredImage mask = codes(60, 50, 3, [](int x, int y) {
    const bool inside = x >= 5 && x <= 15 && y >= 10 && y <= 20;
    return inside ? std::vector<int>{0, 0, 0} : std::vector<int>{255, 255, 255};
  });
  options.mask = &mask;
  check();
  // With one pixel less, it shows.
  options.mask = nullptr;
  options.ignored = {{5, 10, 15, 19}};
  EXPECT_EQ(compare(a, b, options).differing, 11u);
  // Nothing left to compare is not a success.
  options.ignored = {{0, 0, 99, 99}};
  EXPECT_FALSE(compare(a, b, options).same);
  const StoredImage small = plain(3, 3, {0, 0, 0});
  options.mask = &small;
  EXPECT_THROW(compare(a, b, options), glint::InputError);
}

/// SSIM by the paper's equation 13, with the 11 x 11 window of its section III.C, over the windows
/// inside the picture; grey pictures of codes.
double similarity(const StoredImage& a, const StoredImage& b) {
  const auto at = [](const StoredImage& image, int x, int y) {
    return double(std::get<0>(image.values)[std::size_t(3 * (image.width * y + x))]);
  };
  double weights[11][11], sum = 0, total = 0;
  for (int j = 0; j < 11; ++j)
    for (int i = 0; i < 11; ++i)
      sum += weights[j][i] = std::exp(-((i - 5) * (i - 5) + (j - 5) * (j - 5)) / (2 * 1.5 * 1.5));
  int windows = 0;
  for (int y = 0; y + 11 <= a.height; ++y)
    for (int x = 0; x + 11 <= a.width; ++x, ++windows) {
      double ma = 0, mb = 0, va = 0, vb = 0, covariance = 0;
      for (int j = 0; j < 11; ++j)
        for (int i = 0; i < 11; ++i) {
          ma += weights[j][i] / sum * at(a, x + i, y + j);
          mb += weights[j][i] / sum * at(b, x + i, y + j);
        }
      for (int j = 0; j < 11; ++j)
        for (int i = 0; i < 11; ++i) {
          const double w = weights[j][i] / sum;
          const double da = at(a, x + i, y + j) - ma, db = at(b, x + i, y + j) - mb;
          va += w * da * da;
          vb += w * db * db;
          covariance += w * da * db;
        }
      const double c1 = std::pow(0.01 * 255, 2), c2 = std::pow(0.03 * 255, 2);
      total +=
          (2 * ma * mb + c1) * (2 * covariance + c2) / ((ma * ma + mb * mb + c1) * (va + vb + c2));
    }
  return total / windows;
}

double ssim(const StoredImage& a, const StoredImage& b) {
  return compare(a, b, asking({"ssim"})).values.at("ssim");
}

TEST(StructuralSimilarity, AsThePaperWritesIt) {
  std::mt19937 random(4);
  const auto grey = [](int width, int height, const std::function<int(int, int)>& code) {
    return codes(width, height, 3, [&](int x, int y) {
      const int c = code(x, y);
      return std::vector<int>{c, c, c};
    });
  };
  const auto wave = [](int x, int y) {
    return int(128 + 60 * std::sin(0.4 * x) + 50 * std::cos(0.3 * y));
  };
  const StoredImage a = grey(37, 29, wave);
  const StoredImage changed[] = {
      grey(37, 29, [&](int x, int y) { return std::min(255, wave(x, y) + 14); }),
      grey(37, 29, [&](int x, int y) { return 128 + (wave(x, y) - 128) / 2; }),
      grey(37, 29, [&](int x, int y) { return 255 - wave(x, y); }),
      grey(37, 29, [&](int, int) { return int(random() % 256); }),
      grey(37, 29, [&](int x, int y) { return (x + y) % 17 == 0 ? 255 : wave(x, y); })};
  // Codes are divided by 255 in float: a relative error of 6e-8 each.
  for (const StoredImage& b : changed) EXPECT_NEAR(ssim(a, b), similarity(a, b), 1e-6);
  EXPECT_EQ(ssim(a, a), 1);
}

TEST(StructuralSimilarity, ClosedCases) {
  // Uniform pictures have only the luminance term: (2 a b + C1) / (a^2 + b^2 + C1).
  const auto even = [](double a, double b) { return (2 * a * b + 1e-4) / (a * a + b * b + 1e-4); };
  const StoredImage half = plain(15, 12, {128, 128, 128});
  for (const int code : {0, 1, 64, 127, 255})
    EXPECT_NEAR(ssim(half, plain(15, 12, {code, code, code})), even(128 / 255.0, code / 255.0),
                1e-6);
  EXPECT_NEAR(ssim(plain(12, 12, {0, 0, 0}), plain(12, 12, {255, 255, 255})), 1e-4 / 1.0001, 1e-7);
  // The paper's window does not fit, so it shrinks to the picture.
  for (const auto& [w, h] : {std::pair{1, 1}, std::pair{1, 30}, std::pair{10, 3}}) {
    EXPECT_EQ(ssim(plain(w, h, {9, 9, 9}), plain(w, h, {9, 9, 9})), 1);
    EXPECT_NEAR(ssim(plain(w, h, {255, 255, 255}), plain(w, h, {51, 51, 51})), even(1, 0.2), 1e-4);
  }
}

TEST(StructuralSimilarity, HoldsForValuesFarAboveOne) {
  const auto stripes = [](double even, double odd) {
    StoredImage image{16, 16, 3, std::vector<float>()};
    for (int i = 0; i < 16 * 16; ++i)
      std::get<2>(image.values)
          .insert(std::get<2>(image.values).end(), 3, float(i % 2 ? odd : even));
    return image;
  };
  const auto flat = [&](double value) { return stripes(value, value); };
  for (const double v : {30.0, 1e4, 1e10, 1e20, 3e38}) {
    EXPECT_NEAR(ssim(flat(v), flat(v)), 1, 1e-12) << v;
    // C1 / m^2 away from -1, of encoded means m, which are above v^(1/2.4).
    EXPECT_NEAR(ssim(flat(v), flat(-v)), -1, 1e-4 / std::pow(v, 1 / 1.2) + 1e-15) << v;
    // Even pictures: the luminance term alone, of values encoded by the power of the sRGB curve.
    // Its offset and C1 are 0.055 and 1e-4 beside 4.3 and more; floats are rounded to 6e-8.
    const double ratio = std::pow(0.5, 1 / 2.4), offset = 0.055 / std::pow(v, 1 / 2.4);
    EXPECT_NEAR(ssim(flat(v), flat(v / 2)), 2 * ratio / (1 + ratio * ratio), offset + 1e-6) << v;
    // The same stripes in the other order: equal variances, opposite covariance.
    if (v >= 1e4) EXPECT_NEAR(ssim(stripes(v, 1.1 * v), stripes(1.1 * v, v)), -1, 2e-3) << v;
  }
}

}  // namespace glint::test::compare_test
