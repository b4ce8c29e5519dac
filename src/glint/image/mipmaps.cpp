#include "glint/image/mipmaps.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "glint/image/srgb.h"

namespace glint {
namespace {

// What of a row or column a texel of the next level covers: two texels, or three of an odd size.
struct Span {
  int first = 0, count = 0;
  std::array<float, 3> weights{};
};

std::vector<Span> spansOf(int from, int to) {
  std::vector<Span> spans(static_cast<std::size_t>(to));
  const double step = double(from) / to;
  for (int i = 0; i < to; ++i) {
    Span& span = spans[std::size_t(i)];
    const double begin = i * step, end = std::min((i + 1) * step, double(from));
    span.first = int(begin);
    for (int t = span.first; t < from && t < end && span.count < 3; ++t) {
      const double overlap = std::min(end, t + 1.0) - std::max(begin, double(t));
      span.weights[std::size_t(span.count++)] = float(overlap / (end - begin));
    }
  }
  return spans;
}

using Level = std::vector<float>;  // linear RGBA

// The next level; fetch(x, y) gives a texel's four linear values.
template <typename Fetch>
Level shrink(int width, int height, int toWidth, int toHeight, Fetch fetch) {
  const std::vector<Span> columns = spansOf(width, toWidth), rows = spansOf(height, toHeight);
  Level level(std::size_t(4) * toWidth * toHeight);
  float* out = level.data();
  for (const Span& row : rows)
    for (const Span& column : columns) {
      std::array<float, 4> sum{};
      for (int y = 0; y < row.count; ++y)
        for (int x = 0; x < column.count; ++x) {
          const float weight = row.weights[std::size_t(y)] * column.weights[std::size_t(x)];
          const std::array<float, 4> texel = fetch(column.first + x, row.first + y);
          for (std::size_t c = 0; c < 4; ++c) sum[c] += weight * texel[c];
        }
      out = std::copy(sum.begin(), sum.end(), out);
    }
  return level;
}

ByteImage rounded(const Level& level, int width, int height, bool isData) {
  ByteImage image;
  image.width = width;
  image.height = height;
  image.values.resize(level.size());
  for (std::size_t i = 0; i < level.size(); ++i)
    image.values[i] = i % 4 == 3 || isData
                          ? std::uint8_t(std::lround(std::min(level[i], 1.0f) * 255.0f))
                          : encodeSrgb8(level[i]);
  return image;
}

}  // namespace

std::vector<ByteImage> mipLevels(const ByteImage& image, bool isData) {
  std::vector<ByteImage> levels;
  Level level;
  int width = image.width, height = image.height;
  while (width > 1 || height > 1) {
    const int toWidth = std::max(1, width / 2), toHeight = std::max(1, height / 2);
    if (levels.empty()) {
      level = shrink(width, height, toWidth, toHeight, [&](int x, int y) {
        const std::uint8_t* t = &image.values[std::size_t(4) * (std::size_t(y) * width + x)];
        if (isData)
          return std::array<float, 4>{float(t[0]) / 255.0f, float(t[1]) / 255.0f,
                                      float(t[2]) / 255.0f, float(t[3]) / 255.0f};
        return std::array<float, 4>{decodeSrgb8(t[0]), decodeSrgb8(t[1]), decodeSrgb8(t[2]),
                                    float(t[3]) / 255.0f};
      });
    } else {
      level = shrink(width, height, toWidth, toHeight, [&](int x, int y) {
        const float* t = &level[std::size_t(4) * (std::size_t(y) * width + x)];
        return std::array<float, 4>{t[0], t[1], t[2], t[3]};
      });
    }
    width = toWidth;
    height = toHeight;
    levels.push_back(rounded(level, width, height, isData));
  }
  return levels;
}

}  // namespace glint
