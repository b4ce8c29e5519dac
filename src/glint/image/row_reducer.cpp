#include "glint/image/row_reducer.h"

#include <algorithm>
#include <cmath>

#include "glint/image/srgb.h"

namespace glint {
namespace {

int halved(int side, int times) { return std::max(1, side >> std::min(times, 30)); }

}  // namespace

RowReducer::RowReducer(int width, int height, int halvings, bool isData)
    : width_(width), height_(height), isData_(isData) {
  image_.width = halved(width, halvings);
  image_.height = halved(height, halvings);
  image_.values.reserve(std::size_t(4) * image_.width * image_.height);
  const double step = double(width) / image_.width;
  for (int i = 0; i < image_.width; ++i) {
    const double begin = i * step, end = std::min((i + 1) * step, double(width));
    Span& span = columns_.emplace_back(Span{int(begin), 0});
    for (int x = span.first; x < width && x < end; ++x, ++span.count)
      weights_.push_back(float((std::min(end, x + 1.0) - std::max(begin, double(x))) / step));
  }
  line_.resize(std::size_t(4) * image_.width);
  sum_.resize(line_.size(), 0);
}

void RowReducer::add(const std::uint8_t* rgba) {
  if (row_ >= height_) return;
  const float* weight = weights_.data();
  float* out = line_.data();
  for (const Span& span : columns_) {
    float sum[4] = {};
    const std::uint8_t* t = rgba + std::size_t(4) * span.first;
    for (int i = 0; i < span.count; ++i, t += 4, ++weight) {
      for (int c = 0; c < 3; ++c)
        sum[c] += *weight * (isData_ ? float(t[c]) / 255.0f : decodeSrgb8(t[c]));
      sum[3] += *weight * (float(t[3]) / 255.0f);
    }
    out = std::copy(sum, sum + 4, out);
  }
  const double step = double(height_) / image_.height, top = row_++, bottom = row_;
  while (done_ < image_.height) {
    const bool last = done_ + 1 == image_.height;
    const double begin = done_ * step, end = last ? height_ : (done_ + 1) * step;
    const double overlap = std::min(end, bottom) - std::max(begin, top);
    if (overlap <= 0) return;
    const auto share = float(overlap / step);
    for (std::size_t i = 0; i < sum_.size(); ++i) sum_[i] += share * line_[i];
    if (end > bottom) return;
    finishRow();
  }
}

void RowReducer::finishRow() {
  for (std::size_t i = 0; i < sum_.size(); ++i)
    image_.values.push_back(i % 4 == 3 || isData_
                                ? std::uint8_t(std::lround(std::min(sum_[i], 1.0f) * 255.0f))
                                : encodeSrgb8(sum_[i]));
  std::fill(sum_.begin(), sum_.end(), 0.0f);
  ++done_;
}

}  // namespace glint
