// Group H: from linear light to the codes of a file.

#include <array>
#include <limits>

#include "glint/image/srgb.h"
#include "glint/stability/bench.h"
#include "glint/stability/scenes.h"

namespace glint::stability {
namespace {

/// IEC 61966-2-1, in double, written apart from what it tests.
double curve(double x) { return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055; }

void expectCode(Record& record, const std::string& what, float linear, int code) {
  record.near(what, encodeSrgb8(linear), code, 0);
}

/// The codes of a picture of an unlit square of that colour, as render encodes it.
std::array<int, 4> pictureCodes(Bench& bench, const glm::dvec3& color, double alpha = 1) {
  Look look = parallel(bench.look(), {0, 0, 1}, 2);
  look.noBackground = alpha < 1;
  Material material = unlitMaterial(color);
  material.alpha = alpha;
  if (alpha < 1) material.alphaMode = AlphaMode::blend;
  const Image image = bench.draw(sceneOf(square(), material), look);
  std::array<std::uint8_t, 16> codes{};
  encodeSrgb8(image.values.data(), 4, 1, codes.data());
  return {codes[0], codes[1], codes[2], codes[3]};
}

void h1(Bench& bench, Record& record) {
  expectCode(record, "0", 0, 0);
  expectCode(record, "-0", -0.0f, 0);
  expectCode(record, "1", 1, 255);
  const auto codes = pictureCodes(bench, {0, 1, 0});
  record.near("picture of 0", codes[0], 0, 0);
  record.near("picture of 1", codes[1], 255, 0);
}

void h2(Bench&, Record& record) {
  const double join = 0.0031308;
  record.near("the two pieces at the join", 12.92 * join, 1.055 * std::pow(join, 1 / 2.4) - 0.055,
              5e-8);
  // 16-bit codes change across it by at most one step at a time.
  int last = encodeSrgb16(0.00312f), worst = 0;
  for (float x = 0.00312f; x < 0.00314f; x += 1e-8f) {
    const int code = encodeSrgb16(x);
    worst = std::max(worst, std::abs(code - last));
    last = code;
  }
  record.within("largest step of 16-bit codes across the join", worst, 0, 1);
}

void h3(Bench& bench, Record& record) {
  const std::pair<float, int> values[] = {{0.5f, 188}, {0.18f, 118}, {0.01f, 25}, {1 / 255.f, 13}};
  for (const auto& [x, code] : values) expectCode(record, numberText(x), x, code);
  const auto codes = pictureCodes(bench, {0.5, 0.18, 0.01});
  for (int i = 0; i < 3; ++i)
    record.near("picture of " + numberText(values[i].first), codes[std::size_t(i)],
                values[i].second, 0);
}

void h4(Bench&, Record& record) {
  record.within("0.2140411, where the curve is 127.5", encodeSrgb8(0.2140411f), 127, 128);
  record.near("the float below the threshold of 128",
              encodeSrgb8(std::nextafter(srgbThresholds[127], 0.0f)), 127, 0);
  record.near("the threshold itself", encodeSrgb8(srgbThresholds[127]), 128, 0);
}

void h5(Bench&, Record& record) {
  double worst = 0;
  int off = 0;
  for (int i = 0; i <= 10000; ++i) {
    const double x = i / 10000.0;
    worst = std::max(worst, 255 * std::abs(curve(x) - std::pow(x, 1 / 2.2)));
    off = std::max(
        off, std::abs(int(encodeSrgb8(float(x))) - int(std::lround(255 * std::pow(x, 1 / 2.2)))));
  }
  record.near("a pure power of 2.2 is off by levels", worst, 8.5, 0.1);
  record.within("and our codes differ from it by", off, 8, 9);
}

void h6(Bench&, Record& record) {
  int wrong = 0;
  for (int code = 0; code < 256; ++code)
    wrong += encodeSrgb8(decodeSrgb8(std::uint8_t(code))) != code;
  record.near("8-bit codes that do not come back", wrong, 0, 0);
  int wrong16 = 0;
  for (int code = 0; code < 65536; ++code)
    wrong16 += encodeSrgb16(decodeSrgb16(std::uint16_t(code))) != code;
  record.near("16-bit codes that do not come back", wrong16, 0, 0);
}

void h7(Bench&, Record& record) {
  const float infinity = std::numeric_limits<float>::infinity();
  expectCode(record, "-0.1", -0.1f, 0);
  expectCode(record, "1.5", 1.5f, 255);
  expectCode(record, "NaN", std::numeric_limits<float>::quiet_NaN(), 0);
  expectCode(record, "infinity", infinity, 255);
  expectCode(record, "-infinity", -infinity, 0);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float pixels[] = {nan, 0, 0, 1, 0.5f, 0.5f, 0.5f, 1, 0, nan, nan, 1};
  std::array<std::uint8_t, 12> codes{};
  record.near("pixels with a NaN that are counted", double(encodeSrgb8(pixels, 3, 1, codes.data())),
              2, 0);
  std::array<std::uint16_t, 12> wide{};
  record.near("the same with 16 bits", double(encodeSrgb16(pixels, 3, 1, wide.data())), 2, 0);
}

void h8(Bench& bench, Record& record) {
  const auto codes = pictureCodes(bench, {0.5, 0.5, 0.5});
  record.near("picture of 0.5, once encoded", codes[0], 188, 0);
  record.near("what encoding twice would give", std::lround(255 * curve(curve(0.5))), 223, 0);
}

void h9(Bench&, Record& record) {
  // The code changes where the curve crosses (k - 1/2)/255, not k/255.
  int wrong = 0;
  double bias = 0;
  for (int k = 1; k < 256; ++k) {
    const float at = srgbThresholds[std::size_t(k - 1)];
    wrong += std::abs(255 * curve(at) - (k - 0.5)) > 1e-4;
    wrong += encodeSrgb8(at) != k || encodeSrgb8(std::nextafter(at, 0.0f)) != k - 1;
  }
  record.near("thresholds that are not at (k - 1/2)/255", wrong, 0, 0);
  for (int i = 0; i < 100000; ++i) {
    const double x = (i + 0.5) / 100000;
    bias += encodeSrgb8(float(x)) - 255 * curve(x);
  }
  record.near("mean bias in levels", bias / 100000, 0, 0.01);
}

void h10(Bench& bench, Record& record) {
  const auto codes = pictureCodes(bench, {0.5, 0.5, 0.5}, 0.5);
  record.near("alpha 0.5 of a picture", codes[3], 128, 0);
  record.near("its colour, divided by alpha before the curve", codes[0], 188, 0);
  const float pixel[] = {0.25f, 0.25f, 0.25f, 0.5f};
  std::array<std::uint8_t, 4> out{};
  encodeSrgb8(pixel, 1, 4, out.data());
  record.near("alpha under an exposure of 4", out[3], 128, 0);
}

const Case outputTable[] = {
    {"H1", "linear 0 and 1", "0 and 255", "exact", "ends of the curve", "", h1},
    {"H2", "linear 0.0031308", "both pieces agree to 5e-8",
     "5e-8: the standard's rounded constants", "the join", "", h2},
    {"H3", "linear 0.5, 0.18, 0.01, 1/255", "188, 118, 25, 13", "exact",
     "without the curve 128, 46, 3, 1", "", h3},
    {"H4", "linear 0.2140411, where the curve is 127.5", "127 or 128; thresholds decide", "exact",
     "a rounding tie", "the code is the number of thresholds at or below the value", h4},
    {"H5", "a pure power of 2.2", "up to 8.5 levels from the curve", "0.1 level", "not sRGB", "",
     h5},
    {"H6", "all codes decoded and encoded, 8 and 16 bits", "identical", "exact", "round trip", "",
     h6},
    {"H7", "-0.1, 1.5, NaN, infinities", "0, 255, 0, 255, 0; NaN is counted", "exact",
     "conversion of NaN to a whole number is undefined", "NaN is written as 0 and counted", h7},
    {"H8", "a picture of 0.5", "188, not 223", "exact", "encoding twice",
     "no driver's sRGB store is used: the CPU encodes", h8},
    {"H9", "the boundaries between codes", "at (k - 1/2)/255", "1e-4 level; mean bias 0.01",
     "truncation costs half a level", "", h9},
    {"H10", "alpha 0.5", "128, untouched by curve and exposure", "exact",
     "alpha is a share, not light", "", h10},
};

}  // namespace

std::span<const Case> outputCases() { return outputTable; }

}  // namespace glint::stability
