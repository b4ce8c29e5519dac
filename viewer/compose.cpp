#include "compose.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace glint::viewer {

std::vector<std::uint8_t> compose(const CodePicture& a, const CodePicture* b,
                                  const Document& document, bool transparent) {
  const std::size_t bytes = std::size_t(4) * std::size_t(a.width) * std::size_t(a.height);
  std::vector<std::uint8_t> out(a.codes, a.codes + bytes);
  const bool both = b && b->width == a.width && b->height == a.height;
  if (both && document.compare == CompareMode::blink) out.assign(b->codes, b->codes + bytes);
  if (both && document.compare == CompareMode::split) {
    const int divider = std::clamp(int(std::lround(document.divider * a.width)), 0, a.width);
    for (int y = 0; y < a.height; ++y) {
      const std::size_t row = std::size_t(4) * std::size_t(a.width) * std::size_t(y);
      std::copy(b->codes + row + 4 * divider, b->codes + row + 4 * a.width,
                out.begin() + std::ptrdiff_t(row) + 4 * divider);
    }
  }
  if (both && document.compare == CompareMode::difference) {
    for (std::size_t i = 0; i < bytes; ++i) {
      const double d = std::abs(int(a.codes[i]) - int(b->codes[i])) * document.amplification;
      out[i] = i % 4 == 3 ? 255 : std::uint8_t(std::min(d, 255.0));
    }
    return out;
  }
  if (transparent) {
    for (int y = 0; y < a.height; ++y)
      for (int x = 0; x < a.width; ++x) {
        std::uint8_t* p = out.data() + 4 * (std::size_t(a.width) * std::size_t(y) + std::size_t(x));
        const int board = ((x / 12 + y / 12) % 2) ? 102 : 153;
        for (int c = 0; c < 3; ++c)
          p[c] = std::uint8_t((p[c] * p[3] + board * (255 - p[3]) + 127) / 255);
        p[3] = 255;
      }
  }
  return out;
}

void layOver(std::vector<std::uint8_t>& pixels, const std::vector<std::uint8_t>& layer) {
  for (std::size_t p = 0; p + 3 < pixels.size() && p + 3 < layer.size(); p += 4) {
    const int alpha = layer[p + 3];
    if (alpha == 0) continue;
    for (std::size_t c = 0; c < 3; ++c)
      pixels[p + c] =
          std::uint8_t((layer[p + c] * alpha + pixels[p + c] * (255 - alpha) + 127) / 255);
  }
}

CompareNumbers compareNumbers(const CodePicture& a, const CodePicture& b) {
  CompareNumbers numbers;
  const std::size_t pixels = std::size_t(a.width) * std::size_t(a.height);
  if (pixels == 0 || a.width != b.width || a.height != b.height) return numbers;
  std::uint64_t sum = 0;
  for (std::size_t p = 0; p < pixels; ++p) {
    int here = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const int d = std::abs(int(a.codes[4 * p + c]) - int(b.codes[4 * p + c]));
      here = std::max(here, d);
      sum += std::uint64_t(d);
    }
    if (here > numbers.largest) {
      numbers.largest = here;
      numbers.where = {int(p % std::size_t(a.width)), int(p / std::size_t(a.width))};
    }
    numbers.pixels += here > 0;
  }
  numbers.mean = double(sum) / (3.0 * double(pixels));
  return numbers;
}

std::size_t markClipped(std::vector<std::uint8_t>& codes, const Image& linear, double exposure) {
  const double scale = std::exp2(exposure);
  std::size_t marked = 0;
  for (std::size_t p = 0; 4 * p < codes.size(); ++p) {
    bool nan = false, over = false, under = false;
    for (std::size_t c = 0; c < 3; ++c) {
      const double v = double(linear.values[4 * p + c]) * scale;
      nan = nan || !std::isfinite(v);
      over = over || v > 1;
      under = under || v < 0;
    }
    std::uint8_t* out = codes.data() + 4 * p;
    if (nan || over || under) {
      ++marked;
      out[0] = nan || over ? 255 : 40;
      out[1] = 30;
      out[2] = nan || under ? 255 : 30;
    } else {
      for (int c = 0; c < 3; ++c) out[c] = std::uint8_t(out[c] / 2);
    }
  }
  return marked;
}

}  // namespace glint::viewer
