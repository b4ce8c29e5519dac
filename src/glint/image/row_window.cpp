#include "glint/image/row_window.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace glint::detail {

RowWindow::RowWindow(std::size_t rowBytes, int height, Start start)
    : rowBytes_(rowBytes),
      height_(height),
      reach_(int(std::clamp<std::size_t>((std::size_t(16) << 20) / rowBytes, 320, 1024))),
      start_(std::move(start)),
      kept_(rowBytes * std::size_t(std::min(reach_, height))) {}

void RowWindow::read(int first, int count, std::byte* out) {
  const std::lock_guard lock(mutex_);
  for (int y = first; y < first + count; ++y, out += rowBytes_) {
    decodeTo(y);
    std::memcpy(out, &kept_[rowBytes_ * std::size_t(y % reach_)], rowBytes_);
  }
}

void RowWindow::readToEnd() {
  const std::lock_guard lock(mutex_);
  if (!ended_) decodeTo(height_ - 1);
}

void RowWindow::decodeTo(int row) {
  if (!next_ || row < decoded_ - reach_) {
    next_ = nullptr;
    decoded_ = 0;
    next_ = start_();
  }
  try {
    for (; decoded_ <= row; ++decoded_) next_(&kept_[rowBytes_ * std::size_t(decoded_ % reach_)]);
  } catch (...) {
    next_ = nullptr;  // a decoder cannot continue after a failure
    throw;
  }
  ended_ = ended_ || decoded_ == height_;
}

}  // namespace glint::detail
