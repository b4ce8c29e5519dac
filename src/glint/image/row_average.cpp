#include "glint/image/row_average.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "glint/image/srgb.h"

namespace glint {

RowAverage::RowAverage(int width, int height, int toWidth, int toHeight,
                       std::function<void(std::span<const float>)> finished)
    : height_(height), toWidth_(toWidth), toHeight_(toHeight), finished_(std::move(finished)) {
  line_.resize(std::size_t(4) * toWidth);
  sum_.resize(line_.size(), 0);
  if (width == 2 * toWidth) return;
  const double step = double(width) / toWidth;
  for (int i = 0; i < toWidth; ++i) {
    const double begin = i * step, end = std::min((i + 1) * step, double(width));
    Span& span = columns_.emplace_back(Span{int(begin), 0});
    for (int x = span.first; x < width && x < end; ++x, ++span.count)
      weights_.push_back(float((std::min(end, x + 1.0) - std::max(begin, double(x))) / step));
  }
}

void RowAverage::averageAcross(const float* row) {
  float* out = line_.data();
  if (columns_.empty()) {
    for (int i = 0; i < toWidth_; ++i, row += 8, out += 4)
      for (int c = 0; c < 4; ++c) out[c] = 0.5f * (row[c] + row[4 + c]);
    return;
  }
  const float* weight = weights_.data();
  for (const Span& span : columns_) {
    float sum[4] = {};
    const float* in = row + std::size_t(4) * span.first;
    for (int i = 0; i < span.count; ++i, in += 4, ++weight)
      for (int c = 0; c < 4; ++c) sum[c] += *weight * in[c];
    out = std::copy(sum, sum + 4, out);
  }
}

void RowAverage::add(const float* row) {
  if (row_ >= height_) return;
  averageAcross(row);
  const double step = double(height_) / toHeight_, top = row_++, bottom = row_;
  while (done_ < toHeight_) {
    const bool last = done_ + 1 == toHeight_;
    const double begin = done_ * step, end = last ? height_ : (done_ + 1) * step;
    const double overlap = std::min(end, bottom) - std::max(begin, top);
    if (overlap <= 0) return;
    const auto share = float(overlap / step);
    for (std::size_t i = 0; i < sum_.size(); ++i) sum_[i] += share * line_[i];
    if (end > bottom) return;
    ++done_;
    finished_(sum_);
    std::fill(sum_.begin(), sum_.end(), 0.0f);
  }
}

void decodeTexels(std::span<const std::uint8_t> codes, bool isData, float* row) {
  if (isData) {
    for (std::size_t i = 0; i < codes.size(); ++i) row[i] = codes[i];
    return;
  }
  for (std::size_t i = 0; i < codes.size(); i += 4) {
    for (std::size_t c = 0; c < 3; ++c) row[i + c] = decodeSrgb8(codes[i + c]);
    row[i + 3] = codes[i + 3];
  }
}

void encodeTexels(std::span<const float> row, bool isData, std::uint8_t* codes) {
  // The sum is exact in double. Rounding in the means may lift white slightly above 255.
  // NOLINTNEXTLINE(bugprone-incorrect-roundings): no value is below 0
  const auto rounded = [](float v) { return std::uint8_t(std::min(double(v), 255.0) + 0.5); };
  if (isData) {
    for (std::size_t i = 0; i < row.size(); ++i) codes[i] = rounded(row[i]);
    return;
  }
  constexpr std::size_t most = 256;
  std::uint8_t colors[3 * most];
  for (std::size_t first = 0; first < row.size(); first += 4 * most) {
    const std::size_t count = std::min(most, (row.size() - first) / 4);
    encodeSrgb8Opaque(row.data() + first, count, 1.0f, colors);
    for (std::size_t i = 0; i < count; ++i) {
      std::copy(colors + 3 * i, colors + 3 * i + 3, codes + first + 4 * i);
      codes[first + 4 * i + 3] = rounded(row[first + 4 * i + 3]);
    }
  }
}

}  // namespace glint
