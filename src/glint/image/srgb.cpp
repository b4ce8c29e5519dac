#include "glint/image/srgb.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace glint {
namespace {

// The floats from 2^-13, which is below the first threshold, to 1 fall into buckets by exponent and
// the upper 7 bits of the mantissa. A bucket holds at most one threshold, so the code of a value is
// the code at the bucket's beginning plus one if the value's lower 16 bits have reached the
// threshold's. Entry: that first code << 16, plus 2^16 - (the threshold's lower 16 bits) if there
// is one; adding the value's lower bits then carries into the code exactly from the threshold on.
constexpr int lowBits = 16;
constexpr std::uint32_t lowMask = (1u << lowBits) - 1;
constexpr float smallest = 0x1p-13f;
constexpr std::uint32_t smallestBits = std::bit_cast<std::uint32_t>(smallest);
constexpr std::size_t bucketCount =
    ((std::bit_cast<std::uint32_t>(1.0f) - smallestBits) >> lowBits) + 1;

constexpr std::array<std::uint32_t, bucketCount> makeBuckets() {
  std::array<std::uint32_t, bucketCount> buckets{};
  std::size_t threshold = 0;  // also the code of the values just below that threshold
  for (std::size_t bucket = 0; bucket < bucketCount; ++bucket) {
    buckets[bucket] = static_cast<std::uint32_t>(threshold << lowBits);
    if (threshold == detail::srgbThresholdBits.size()) continue;
    const std::uint32_t offset = detail::srgbThresholdBits[threshold] - smallestBits;
    if (offset >> lowBits != bucket) continue;
    buckets[bucket] += (1u << lowBits) - (offset & lowMask);
    ++threshold;
  }
  return buckets;
}

constexpr std::array<std::uint32_t, bucketCount> buckets = makeBuckets();
// A second threshold in one bucket would have stopped makeBuckets from reaching the last.
static_assert(buckets.back() == 255u << lowBits);

/// The offset of a value into the buckets: the bucket's index and the lower bits.
inline std::uint32_t offsetOf(float linear) {
  const float above = linear > smallest ? linear : smallest;  // NaN becomes `smallest`, code 0
  const float inside = above < 1.0f ? above : 1.0f;
  return std::bit_cast<std::uint32_t>(inside) - smallestBits;
}

inline std::uint8_t codeAt(std::uint32_t offset) {
  return static_cast<std::uint8_t>((buckets[offset >> lowBits] + (offset & lowMask)) >> lowBits);
}

inline std::uint8_t codeOf(float linear) { return codeAt(offsetOf(linear)); }

constexpr std::size_t blockPixels = 64;

/// The bucket offsets of `count` scaled values; returns whether any is NaN. Separate from the
/// look-up because the compiler can vectorise this part.
bool offsetsOf(const float* values, std::size_t count, float scale, std::uint32_t* offsets) {
  std::uint32_t nan = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const float value = values[i] * scale;
    nan |= value != value ? 1 : 0;
    offsets[i] = offsetOf(value);
  }
  return nan != 0;
}

double clampToUnit(double value) { return value > 0 ? std::min(value, 1.0) : 0; }

/// Rounded to nearest; the products are exact in double.
std::uint8_t alpha8(float alpha) {
  return static_cast<std::uint8_t>(std::lround(clampToUnit(alpha) * 255));
}
std::uint16_t alpha16(float alpha) {
  return static_cast<std::uint16_t>(std::lround(clampToUnit(alpha) * 65535));
}

bool hasNanColour(const float* rgba) {
  return std::isnan(rgba[0]) || std::isnan(rgba[1]) || std::isnan(rgba[2]);
}

std::size_t countNanColours(const float* rgba, std::size_t pixels) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < pixels; ++i) count += hasNanColour(rgba + 4 * i);
  return count;
}

std::size_t countNanPixels(const float* rgba, std::size_t pixels) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < pixels; ++i) {
    count += hasNanColour(rgba + 4 * i) || std::isnan(rgba[4 * i + 3]);
  }
  return count;
}

bool allOpaque(const float* rgba, std::size_t pixels) {
  std::size_t opaque = 0;
  for (std::size_t i = 0; i < pixels; ++i) opaque += rgba[4 * i + 3] >= 1;
  return opaque == pixels;
}

/// The colours before encoding: scaled, and with the premultiplication undone; alpha is unchanged.
void straighten(const float* rgba, std::size_t pixels, float scale, float* straight) {
  for (std::size_t i = 0; i < pixels; ++i) {
    const float alpha = rgba[4 * i + 3];
    const float divisor = alpha < 1 ? alpha : 1;
    for (std::size_t channel = 0; channel < 3; ++channel) {
      const float value = rgba[4 * i + channel] * scale / divisor;
      straight[4 * i + channel] = alpha > 0 ? value : 0;
    }
    straight[4 * i + 3] = alpha;
  }
}

/// The cube root of a positive, normal number to 2 ulp, the same on every processor: a guess by
/// dividing the exponent (within 6 %), then Halley's iteration, which triples the digits.
double cubeRoot(double x) {
  const auto bits = std::bit_cast<std::uint64_t>(x);
  double root = std::bit_cast<double>(bits / 3 + 0x2a9f7893782da1ceu);
  for (int i = 0; i < 3; ++i) {
    const double cube = root * root * root;
    root *= (cube + 2 * x) / (2 * cube + x);
  }
  return root;
}

}  // namespace

std::uint8_t encodeSrgb8(float linear) { return codeOf(linear); }

std::uint16_t encodeSrgb16(float linear) {
  if (!(linear > 0)) return 0;
  if (linear >= 1) return 65535;
  double encoded = 12.92 * static_cast<double>(linear);
  if (linear > 0.0031308) {
    const double root = cubeRoot(linear);  // x^(1/2.4) = x^(1/3) (x^(1/3))^(1/4)
    encoded = 1.055 * (root * std::sqrt(std::sqrt(root))) - 0.055;
  }
  return static_cast<std::uint16_t>(std::lround(65535 * encoded));
}

float decodeSrgb16(std::uint16_t code) { return static_cast<float>(srgbLinear(code / 65535.0)); }

std::size_t encodeSrgb8(const float* rgba, std::size_t pixels, float scale, std::uint8_t* out) {
  std::size_t nanPixels = 0;
  std::uint32_t offsets[4 * blockPixels];
  float straight[4 * blockPixels];
  for (std::size_t first = 0; first < pixels; first += blockPixels) {
    const std::size_t count = std::min(blockPixels, pixels - first);
    const float* in = rgba + 4 * first;
    std::uint8_t* codes = out + 4 * first;
    const bool opaque = allOpaque(in, count);
    if (opaque) {
      if (offsetsOf(in, 4 * count, scale, offsets)) nanPixels += countNanPixels(in, count);
    } else {
      nanPixels += countNanPixels(in, count);
      straighten(in, count, scale, straight);
      offsetsOf(straight, 4 * count, 1.0f, offsets);
    }
    for (std::size_t i = 0; i < 4 * count; ++i) codes[i] = codeAt(offsets[i]);
    for (std::size_t i = 0; i < count; ++i) codes[4 * i + 3] = opaque ? 255 : alpha8(in[4 * i + 3]);
  }
  return nanPixels;
}

std::size_t encodeSrgb8Opaque(const float* rgba, std::size_t pixels, float scale,
                              std::uint8_t* out) {
  std::size_t nanPixels = 0;
  std::uint32_t offsets[4 * blockPixels];
  for (std::size_t first = 0; first < pixels; first += blockPixels) {
    const std::size_t count = std::min(blockPixels, pixels - first);
    const float* in = rgba + 4 * first;
    if (offsetsOf(in, 4 * count, scale, offsets)) nanPixels += countNanColours(in, count);
    std::uint8_t* codes = out + 3 * first;
    for (std::size_t i = 0; i < count; ++i) {
      codes[3 * i] = codeAt(offsets[4 * i]);
      codes[3 * i + 1] = codeAt(offsets[4 * i + 1]);
      codes[3 * i + 2] = codeAt(offsets[4 * i + 2]);
    }
  }
  return nanPixels;
}

std::size_t encodeSrgb16(const float* rgba, std::size_t pixels, float scale, std::uint16_t* out) {
  for (std::size_t i = 0; i < pixels; ++i) {
    float straight[4];
    straighten(rgba + 4 * i, 1, scale, straight);
    for (std::size_t channel = 0; channel < 3; ++channel) {
      out[4 * i + channel] = encodeSrgb16(straight[channel]);
    }
    out[4 * i + 3] = alpha16(straight[3]);
  }
  return countNanPixels(rgba, pixels);
}

std::size_t encodeSrgb16Opaque(const float* rgba, std::size_t pixels, float scale,
                               std::uint16_t* out) {
  for (std::size_t i = 0; i < pixels; ++i) {
    for (std::size_t channel = 0; channel < 3; ++channel) {
      out[3 * i + channel] = encodeSrgb16(rgba[4 * i + channel] * scale);
    }
  }
  return countNanColours(rgba, pixels);
}

}  // namespace glint
