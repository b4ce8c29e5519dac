#include "glint/render/normal_lengths.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "glint/image/row_average.h"

namespace glint {

std::uint8_t normalSpreadCode(double length) {
  if (!(length > 0.5)) return 0;
  const double width = std::sqrt(std::max(1 - length, 0.0) / length);
  return std::uint8_t(255 - std::lround(255 * std::min(width, 1.0)));
}

// Means in floats are off by about 1e-7 a level, less than 3.8e-6, the variance of half a code next
// to 255.
void writeNormalLengths(DecodedImage& decoded) {
  ByteImage& base = decoded.image;
  for (std::size_t i = 3; i < base.values.size(); i += 4) base.values[i] = 255;
  std::vector<ByteImage>& levels = decoded.mipLevels;
  std::vector<RowAverage> steps;
  steps.reserve(levels.size());
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const ByteImage& from = i == 0 ? base : levels[i - 1];
    steps.emplace_back(
        from.width, from.height, levels[i].width, levels[i].height,
        [&steps, i, out = levels[i].values.data()](std::span<const float> row) mutable {
          for (std::size_t k = 0; k < row.size(); k += 4, out += 4)
            out[3] = normalSpreadCode(std::hypot(row[k], row[k + 1], row[k + 2]));
          if (i + 1 < steps.size()) steps[i + 1].add(row.data());
        });
  }
  if (steps.empty()) return;
  std::vector<float> row(std::size_t(4) * base.width);
  const std::uint8_t* in = base.values.data();
  for (int line = 0; line < base.height; ++line) {
    for (std::size_t k = 0; k < row.size(); k += 4, in += 4) {
      // 2 texel - 1 in 255ths: whole and odd, so that no normal is 0.
      const double x = 2 * in[0] - 255, y = 2 * in[1] - 255, z = 2 * in[2] - 255;
      const double scale = 1 / std::sqrt(x * x + y * y + z * z);
      row[k] = float(scale * x);
      row[k + 1] = float(scale * y);
      row[k + 2] = float(scale * z);
    }
    steps[0].add(row.data());
  }
}

}  // namespace glint
