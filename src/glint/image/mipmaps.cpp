#include "glint/image/mipmaps.h"

#include <algorithm>
#include <cstddef>
#include <span>

#include "glint/image/row_average.h"

namespace glint {

std::vector<ByteImage> mipLevels(const ByteImage& image, bool isData) {
  std::vector<ByteImage> levels;
  for (int width = image.width, height = image.height; width > 1 || height > 1;) {
    width = std::max(1, width / 2);
    height = std::max(1, height / 2);
    levels.push_back({width, height, 4, {}});
    levels.back().values.resize(std::size_t(4) * width * height);
  }
  // Each row is passed down the pyramid as soon as it is finished, while it is in the cache.
  std::vector<RowAverage> steps;
  steps.reserve(levels.size());
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const ByteImage& from = i == 0 ? image : levels[i - 1];
    steps.emplace_back(
        from.width, from.height, levels[i].width, levels[i].height,
        [&, isData, i, out = levels[i].values.data()](std::span<const float> row) mutable {
          encodeTexels(row, isData, out);
          out += row.size();
          if (i + 1 < steps.size()) steps[i + 1].add(row.data());
        });
  }
  std::vector<float> row(std::size_t(4) * image.width);
  for (int y = 0; !steps.empty() && y < image.height; ++y) {
    decodeTexels(std::span(image.values).subspan(row.size() * y, row.size()), isData, row.data());
    steps[0].add(row.data());
  }
  return levels;
}

}  // namespace glint
