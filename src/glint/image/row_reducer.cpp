#include "glint/image/row_reducer.h"

#include <algorithm>
#include <cstddef>

namespace glint {
namespace {

int halved(int side, int times) { return std::max(1, side >> std::min(times, 30)); }

}  // namespace

RowReducer::RowReducer(int width, int height, int halvings, bool isData)
    : isData_(isData),
      image_{halved(width, halvings), halved(height, halvings), 4, {}},
      line_(std::size_t(4) * width),
      average_(width, height, image_.width, image_.height, [this](std::span<const float> row) {
        const std::size_t before = image_.values.size();
        image_.values.resize(before + row.size());
        encodeTexels(row, isData_, image_.values.data() + before);
      }) {
  image_.values.reserve(std::size_t(4) * image_.width * image_.height);
}

void RowReducer::add(const std::uint8_t* rgba) {
  decodeTexels({rgba, line_.size()}, isData_, line_.data());
  average_.add(line_.data());
}

}  // namespace glint
