#include <bit>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "glint/image/file.h"
#include "glint/image/format_writers.h"

namespace glint::detail {
namespace {

/// 32-bit little-endian words: "GLNT", width, height, channels, then the values.
class RawWriter : public PictureWriter {
 public:
  RawWriter(const std::string& path, int width, int height, bool alpha)
      : PictureWriter(path, width, height), file_(path), channels_(alpha ? 4 : 3) {}

 private:
  void writeRows(const Image& rows) override {
    words_.clear();
    if (rowsWritten_ == 0 && !begun_) {
      begun_ = true;
      for (const std::uint32_t word :
           {0x544e4c47u, std::uint32_t(width_), std::uint32_t(height_), std::uint32_t(channels_)})
        add(word);
    }
    const std::size_t pixels = std::size_t(rows.width) * rows.height;
    for (std::size_t i = 0; i < pixels; ++i) {
      bool nan = false;
      for (int c = 0; c < channels_; ++c) {
        const float value = rows.values[4 * i + std::size_t(c)];
        nan = nan || std::isnan(value);
        add(std::bit_cast<std::uint32_t>(value));
      }
      nanPixels_ += nan;
    }
    file_.write(std::as_bytes(std::span(words_)));
  }

  void add(std::uint32_t word) {
    words_.push_back(std::endian::native == std::endian::little ? word : __builtin_bswap32(word));
  }

  void finishFile() override { file_.commit(); }

  OutputFile file_;
  const int channels_;
  bool begun_ = false;
  std::vector<std::uint32_t> words_;
};

}  // namespace

std::unique_ptr<PictureWriter> openRaw(const std::string& path, int width, int height,
                                       const PictureOptions& options) {
  return std::make_unique<RawWriter>(path, width, height, options.alpha);
}

}  // namespace glint::detail
