#include "glint/image/stored_image.h"

#include <cmath>

#include "glint/image/row_window.h"
#include "glint/image/srgb.h"

namespace glint {
namespace {

/// The linear values of all 16-bit codes.
const float* decodedWords() {
  static const std::vector<float> table = [] {
    std::vector<float> values(65536);
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] = decodeSrgb16(static_cast<std::uint16_t>(i));
    }
    return values;
  }();
  return table.data();
}

const float* decodedCodes(const std::uint8_t*) { return srgbDecoded.data(); }
const float* decodedCodes(const std::uint16_t*) { return decodedWords(); }

template <class Code>
void codesToLinear(const Code* codes, int channels, std::size_t pixels, float* rgba) {
  constexpr float maxCode = static_cast<Code>(-1);
  const float* linear = decodedCodes(codes);
  for (std::size_t i = 0; i < pixels; ++i, codes += channels, rgba += 4) {
    const float alpha = channels == 4 ? codes[3] / maxCode : 1;
    for (int c = 0; c < 3; ++c) rgba[c] = linear[codes[c]] * alpha;
    rgba[3] = alpha;
  }
}

/// Where alpha is 0, colours are 0 unless `stored` requests them as they are.
template <class Code>
void codesToValues(const Code* codes, int channels, std::size_t pixels, bool stored, float* rgba) {
  constexpr float maxCode = static_cast<Code>(-1);
  for (std::size_t i = 0; i < pixels; ++i, codes += channels, rgba += 4) {
    const bool seen = stored || channels == 3 || codes[3] > 0;
    for (int c = 0; c < 3; ++c) rgba[c] = seen ? codes[c] / maxCode : 0;
    rgba[3] = channels == 4 ? codes[3] / maxCode : 1;
  }
}

}  // namespace

float encodedValue(float linear) {
  return static_cast<float>(std::copysign(srgbEncoded(std::fabs(double(linear))), linear));
}

float decodedValue(float encoded) {
  return static_cast<float>(std::copysign(srgbLinear(std::fabs(double(encoded))), encoded));
}

void StoredImage::readWindow(int first, int count, void* out) const {
  window->read(first, count, static_cast<std::byte*>(out));
}

void StoredImage::linearRows(int first, int count, float* rgba) const {
  const std::size_t pixels = std::size_t(width) * count;
  if (values.index() == 0) {
    std::vector<std::uint8_t> copy;
    codesToLinear(heldRows(first, count, copy), channels, pixels, rgba);
  } else if (values.index() == 1) {
    std::vector<std::uint16_t> copy;
    codesToLinear(heldRows(first, count, copy), channels, pixels, rgba);
  } else {
    std::vector<float> copy;
    const float* in = heldRows(first, count, copy);
    for (std::size_t i = 0; i < pixels; ++i, in += channels, rgba += 4) {
      for (int c = 0; c < 3; ++c) rgba[c] = in[channels == 1 ? 0 : c];
      rgba[3] = channels == 4 ? in[3] : 1;
    }
  }
}

void StoredImage::storedRows(int first, int count, float* rgba) const {
  if (isEncoded()) {
    codeRows(first, count, true, rgba);
  } else {
    linearRows(first, count, rgba);
  }
}

void StoredImage::codeRows(int first, int count, bool stored, float* rgba) const {
  const std::size_t pixels = std::size_t(width) * count;
  if (values.index() == 0) {
    std::vector<std::uint8_t> copy;
    codesToValues(heldRows(first, count, copy), channels, pixels, stored, rgba);
  } else {
    std::vector<std::uint16_t> copy;
    codesToValues(heldRows(first, count, copy), channels, pixels, stored, rgba);
  }
}

void StoredImage::encodedRows(int first, int count, float* rgba) const {
  const std::size_t pixels = std::size_t(width) * count;
  if (isEncoded()) {
    codeRows(first, count, false, rgba);
    return;
  }
  linearRows(first, count, rgba);
  for (std::size_t i = 0; i < pixels; ++i, rgba += 4) {
    const float alpha = rgba[3];
    for (int c = 0; c < 3; ++c) {
      const float straight = alpha > 0 && alpha < 1 ? rgba[c] / alpha : rgba[c];
      rgba[c] = alpha <= 0 && !std::isnan(straight) ? 0 : encodedValue(straight);
    }
  }
}

}  // namespace glint
