#include "glint/image/srgb.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <boost/multiprecision/cpp_dec_float.hpp>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <random>
#include <thread>
#include <vector>

namespace srgb_test {

using Decimal = boost::multiprecision::cpp_dec_float_50;

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float nan = std::numeric_limits<float>::quiet_NaN();

/// IEC 61966-2-1 with its published constants.
Decimal linearOf(const Decimal& encoded) {
  if (encoded <= Decimal("0.04045")) return encoded / Decimal("12.92");
  return pow((encoded + Decimal("0.055")) / Decimal("1.055"), Decimal("2.4"));
}

Decimal encodedOf(const Decimal& linear) {
  if (linear <= Decimal("0.0031308")) return linear * Decimal("12.92");
  return Decimal("1.055") * pow(linear, 1 / Decimal("2.4")) - Decimal("0.055");
}

/// Whether no other float is nearer to the exact value.
bool isNearest(float value, const Decimal& exact) {
  const Decimal error = abs(Decimal(value) - exact);
  return error <= abs(Decimal(std::nextafter(value, infinity)) - exact) &&
         error <= abs(Decimal(std::nextafter(value, -infinity)) - exact);
}

/// The definition itself: the number of thresholds <= x, 0 for NaN.
int definedCode(float x) {
  if (std::isnan(x)) return 0;
  const auto& thresholds = glint::srgbThresholds;
  return static_cast<int>(std::upper_bound(thresholds.begin(), thresholds.end(), x) -
                          thresholds.begin());
}

/// The number of floats from `first` to `last` (bit patterns, inclusive) whose code is wrong,
/// encoded singly or in bulk.
std::size_t wrongCodes(std::uint32_t first, std::uint32_t last) {
  constexpr std::size_t pixels = 1024;
  std::vector<float> values(4 * pixels, 1.0f);
  std::vector<std::uint8_t> codes(3 * pixels);
  std::size_t wrong = 0;
  for (std::uint64_t begin = first; begin <= last; begin += 3 * pixels) {
    const std::size_t count = std::min<std::uint64_t>(3 * pixels, last - begin + 1);
    for (std::size_t i = 0; i < count; ++i) {
      values[i / 3 * 4 + i % 3] = std::bit_cast<float>(static_cast<std::uint32_t>(begin + i));
    }
    glint::encodeSrgb8Opaque(values.data(), pixels, 1, codes.data());
    int expected = definedCode(values[0]);
    for (std::size_t i = 0; i < count; ++i) {
      const float x = values[i / 3 * 4 + i % 3];
      while (expected < 255 && glint::srgbThresholds[expected] <= x) ++expected;
      wrong += codes[i] != expected || glint::encodeSrgb8(x) != expected;
    }
  }
  return wrong;
}

TEST(Srgb, ThresholdsAreTheNearestFloatsToTheExactOnes) {
  for (int k = 1; k <= 255; ++k) {
    EXPECT_TRUE(isNearest(glint::srgbThresholds[k - 1], linearOf(Decimal(2 * k - 1) / 510))) << k;
  }
}

TEST(Srgb, DecodedCodesAreTheNearestFloatsToTheExactOnes) {
  EXPECT_EQ(glint::decodeSrgb8(0), 0.0f);
  for (int k = 1; k <= 255; ++k) {
    EXPECT_TRUE(isNearest(glint::decodeSrgb8(k), linearOf(Decimal(k) / 255))) << k;
  }
}

TEST(Srgb, CodesAreAsDefinedNearEveryThresholdAndBucketEdge) {
  for (const float threshold : glint::srgbThresholds) {
    const auto bits = std::bit_cast<std::uint32_t>(threshold);
    EXPECT_EQ(wrongCodes(bits - 4, bits + 4), 0u) << threshold;
  }
  const auto one = std::bit_cast<std::uint32_t>(1.0f);
  for (std::uint32_t edge = 1u << 15; edge <= one; edge += 1u << 15) {
    ASSERT_EQ(wrongCodes(edge - 4, edge + 4), 0u) << std::bit_cast<float>(edge);
  }
}

TEST(Srgb, CodesAreAsDefinedForRandomBits) {
  std::mt19937 random(1);
  for (int i = 0; i < 1000000; ++i) {
    const float x = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
    ASSERT_EQ(glint::encodeSrgb8(x), definedCode(x)) << x;
  }
}

// Every float from 0 to 1; takes four seconds on two cores.
TEST(Srgb, CodesAreAsDefinedForEveryFloat) {
  const unsigned parts = std::max(1u, std::thread::hardware_concurrency());
  const std::uint32_t end = std::bit_cast<std::uint32_t>(1.0f) + 1;
  std::vector<std::size_t> wrong(parts);
  std::vector<std::thread> threads;
  for (unsigned part = 0; part < parts; ++part) {
    threads.emplace_back([&, part] {
      const std::uint64_t first = std::uint64_t(end) * part / parts;
      const std::uint64_t last = std::uint64_t(end) * (part + 1) / parts - 1;
      wrong[part] = wrongCodes(static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(last));
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const std::size_t count : wrong) EXPECT_EQ(count, 0u);
}

TEST(Srgb, KnownCodes) {
  EXPECT_EQ(glint::encodeSrgb8(0.0f), 0);
  EXPECT_EQ(glint::encodeSrgb8(1.0f), 255);
  EXPECT_EQ(glint::encodeSrgb8(0.5f), 188);  // without the curve 128, with it twice 223
  EXPECT_EQ(glint::encodeSrgb8(0.18f), 118);
  EXPECT_EQ(glint::encodeSrgb8(0.01f), 25);
  EXPECT_EQ(glint::encodeSrgb8(1 / 255.0f), 13);
  EXPECT_EQ(glint::encodeSrgb8(0.0031308f), 10);
  const int tie = glint::encodeSrgb8(0.2140411f);
  EXPECT_TRUE(tie == 127 || tie == 128) << tie;
}

TEST(Srgb, ValuesOutsideTheUnitIntervalAndNan) {
  for (const float x : {-0.1f, -infinity, nan, -nan, -0.0f, 1e-40f}) {
    EXPECT_EQ(glint::encodeSrgb8(x), 0) << x;
    EXPECT_EQ(glint::encodeSrgb16(x), 0) << x;
  }
  for (const float x : {1.5f, 1e30f, infinity}) {
    EXPECT_EQ(glint::encodeSrgb8(x), 255) << x;
    EXPECT_EQ(glint::encodeSrgb16(x), 65535) << x;
  }
}

TEST(Srgb, RoundsAndDoesNotTruncate) {
  // The code's own value minus half a code's width still belongs to the code.
  for (int k = 1; k <= 255; ++k) {
    const float half = static_cast<float>(linearOf(Decimal(k - 0.49) / 255));
    ASSERT_EQ(glint::encodeSrgb8(half), k);
  }
}

TEST(Srgb, DecodedCodesEncodeToThemselves) {
  for (int k = 0; k < 256; ++k) EXPECT_EQ(glint::encodeSrgb8(glint::decodeSrgb8(k)), k);
  for (int k = 0; k < 65536; ++k) ASSERT_EQ(glint::encodeSrgb16(glint::decodeSrgb16(k)), k);
}

TEST(Srgb, SixteenBitCodesAreTheRoundedCurve) {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> exponent(-20, 0);
  std::vector<float> values{0.0031308f, std::nextafter(0.0031308f, 1.0f), 0.5f, 0x1.fffffep-1f};
  for (int i = 0; i < 2000; ++i) values.push_back(std::exp2(exponent(random)));
  for (const float x : values) {
    const Decimal exact = 65535 * encodedOf(Decimal(x));
    // Half a code, and the documented 1e-10 of 65535 if the exact value is that near a tie.
    EXPECT_LE(abs(Decimal(glint::encodeSrgb16(x)) - exact), Decimal(0.5 + 65535e-10)) << x;
  }
}

TEST(Srgb, AlphaIsLinearAndColoursAreDividedByIt) {
  const float rgba[] = {0.25f, 0.1f, 0.5f, 0.5f,  0.3f, 0.3f, 0.3f,  0.0f,
                        0.2f,  0.2f, 0.2f, -1.0f, 0.5f, 2.0f, -1.0f, 2.0f};
  std::uint8_t out[16];
  EXPECT_EQ(glint::encodeSrgb8(rgba, 4, 1, out), 0u);
  const std::vector<int> expected{
      188, definedCode(0.1f / 0.5f), 255, 128, 0, 0, 0, 0, 0, 0, 0, 0, 188, 255, 0, 255};
  EXPECT_EQ(std::vector<int>(out, out + 16), expected);
}

TEST(Srgb, ScaleMultipliesColoursAndNotAlpha) {
  const float rgba[] = {0.125f, 0.25f, 0.5f, 0.5f};
  std::uint8_t straight[4];
  glint::encodeSrgb8(rgba, 1, 2, straight);
  EXPECT_EQ(std::vector<int>(straight, straight + 4), (std::vector<int>{188, 255, 255, 128}));
  std::uint8_t opaque[3];
  glint::encodeSrgb8Opaque(rgba, 1, 2, opaque);
  EXPECT_EQ(std::vector<int>(opaque, opaque + 3), (std::vector<int>{definedCode(0.25f), 188, 255}));
}

TEST(Srgb, NanPixelsAreCountedOnceEach) {
  std::vector<float> rgba(4 * 200, 1.0f);
  rgba[0] = rgba[1] = nan;  // one pixel, two NaN
  rgba[4 * 77 + 2] = -nan;  // another block
  rgba[4 * 199 + 3] = nan;  // in alpha alone
  std::vector<std::uint8_t> out(4 * 200);
  std::vector<std::uint16_t> out16(4 * 200);
  EXPECT_EQ(glint::encodeSrgb8(rgba.data(), 200, 1, out.data()), 3u);
  EXPECT_EQ(out[0], 0);
  EXPECT_EQ(out[2], 255);
  EXPECT_EQ(out[4 * 199], 0);
  EXPECT_EQ(out[4 * 199 + 3], 0);
  EXPECT_EQ(glint::encodeSrgb16(rgba.data(), 200, 1, out16.data()), 3u);
  EXPECT_EQ(glint::encodeSrgb8Opaque(rgba.data(), 200, 1, out.data()), 2u);
  EXPECT_EQ(glint::encodeSrgb16Opaque(rgba.data(), 200, 1, out16.data()), 2u);
}

TEST(Srgb, BulkAndSingleCodesAgreeAtEveryCountAndAlpha) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> unit(-0.1f, 1.1f);
  for (std::size_t pixels = 0; pixels < 200; ++pixels) {
    std::vector<float> rgba(4 * pixels);
    for (std::size_t i = 0; i < rgba.size(); ++i) {
      rgba[i] = i % 4 == 3 && pixels % 2 == 0 ? 1 : unit(random);
    }
    std::vector<std::uint8_t> out(4 * pixels + 1, 77);
    glint::encodeSrgb8(rgba.data(), pixels, 1.5f, out.data());
    for (std::size_t i = 0; i < pixels; ++i) {
      const float alpha = rgba[4 * i + 3];
      for (std::size_t channel = 0; channel < 3; ++channel) {
        const float value = rgba[4 * i + channel] * 1.5f;
        const int expected = alpha > 0 ? definedCode(alpha < 1 ? value / alpha : value) : 0;
        ASSERT_EQ(out[4 * i + channel], expected);
      }
      ASSERT_EQ(out[4 * i + 3], std::lround(255.0 * std::clamp(alpha, 0.0f, 1.0f)));
    }
    ASSERT_EQ(out.back(), 77) << "wrote beyond the end";
  }
}

}  // namespace srgb_test
