#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>

#include "glint/image/file.h"
#include "glint/image/format_writers.h"

namespace glint::detail {
namespace {

std::uint32_t littleEndian(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  return std::endian::native == std::endian::little ? bits : __builtin_bswap32(bits);
}

std::span<const std::byte> bytesOf(const std::string& text) {
  return std::as_bytes(std::span(text.data(), text.size()));
}

class PfmWriter : public PictureWriter {
 public:
  PfmWriter(const std::string& path, int width, int height)
      : PictureWriter(path, width, height),
        file_(path),
        header_("PF\n" + std::to_string(width) + " " + std::to_string(height) + "\n-1.0\n") {
    file_.writeAt(0, bytesOf(header_));
  }

 private:
  void writeRows(const Image& rows) override {
    constexpr int blockRows = 32;
    for (int first = 0; first < rows.height; first += blockRows) {
      const int count = std::min(blockRows, rows.height - first);
      block_.clear();
      for (int y = first + count - 1; y >= first; --y) addRow(rows.row(y));
      const auto rowBytes = std::uint64_t(12) * width_;
      const int rowsBelow = height_ - rowsWritten_ - first - count;
      file_.writeAt(header_.size() + rowBytes * rowsBelow, std::as_bytes(std::span(block_)));
    }
  }

  void addRow(const float* rgba) {
    for (int x = 0; x < width_; ++x) {
      bool nan = false;
      for (int channel = 0; channel < 3; ++channel) {
        const float value = rgba[4 * x + channel];
        nan = nan || std::isnan(value);
        block_.push_back(littleEndian(value));
      }
      nanPixels_ += nan;
    }
  }

  void finishFile() override { file_.commit(); }

  OutputFile file_;
  const std::string header_;
  std::vector<std::uint32_t> block_;  ///< rows from the bottom up, as in the file
};

}  // namespace

std::unique_ptr<PictureWriter> openPfm(const std::string& path, int width, int height) {
  return std::make_unique<PfmWriter>(path, width, height);
}

}  // namespace glint::detail
