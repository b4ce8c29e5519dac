#include <charconv>
#include <cmath>
#include <cstring>
#include <string_view>

#include "glint/image/decoders.h"

namespace glint::detail {
namespace {

constexpr std::size_t headerLimit = 1 << 16;

/// Reads the parts of a Radiance picture (Ward, "Real Pixels", Graphics Gems II, 1991; the
/// "filefmts" document of Radiance).
class HdrReader {
 public:
  HdrReader(std::span<const std::byte> bytes, const std::string& name)
      : bytes_(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()), name_(name) {}

  StoredImage read() {
    readVariables();
    readSize();
    // Every row takes at least one four-byte pixel.
    if (bytes_.size() - at_ < std::size_t(4) * image_.height) cut();
    const std::size_t rowPixels = std::size_t(image_.width);
    std::vector<unsigned char> row(4 * rowPixels);
    std::vector<float> values(3 * rowPixels * image_.height);
    for (int line = 0; line < image_.height; ++line) {
      readRow(row);
      const int y = upwards_ ? image_.height - 1 - line : line;
      float* out = values.data() + 3 * rowPixels * y;
      for (std::size_t i = 0; i < rowPixels; ++i) {
        const unsigned char* pixel = &row[4 * (leftwards_ ? rowPixels - 1 - i : i)];
        // 2^(e - 128) / 256; no half is added to the mantissa.
        const float scale = pixel[3] == 0 ? 0 : std::ldexp(1.0f, pixel[3] - 136);
        for (int c = 0; c < 3; ++c) *out++ = pixel[c] * scale;
      }
    }
    image_.values = std::move(values);
    return std::move(image_);
  }

 private:
  std::string_view line() {
    const std::size_t begin = at_;
    while (at_ < bytes_.size() && bytes_[at_] != '\n') {
      if (++at_ > headerLimit) fail("header is damaged");
    }
    if (at_ == bytes_.size()) cut();
    return {reinterpret_cast<const char*>(bytes_.data()) + begin, at_++ - begin};
  }

  void readVariables() {
    line();  // "#?RADIANCE"
    for (std::string_view text = line(); !text.empty() && text != "\r"; text = line()) {
      const auto equals = text.find('=');
      if (equals == std::string_view::npos || text.front() == '#') continue;
      std::string key(text.substr(0, equals)), value(text.substr(equals + 1));
      if (!value.empty() && value.back() == '\r') value.pop_back();
      if (key == "FORMAT" && value != "32-bit_rle_rgbe") {
        throw InputError(printablePath(name_) + ": HDR colours of the format '" +
                         printablePath(value) + "': convert it to 32-bit_rle_rgbe");
      }
      image_.text[key] = value;
    }
  }

  void readSize() {
    const std::string_view text = line();
    // "-Y 512 +X 768": rows from the top, pixels from the left.
    std::uint64_t sides[2] = {};
    const char* end = text.data() + text.size();
    const char* at = text.data();
    for (int side = 0; side < 2; ++side) {
      while (at != end && *at == ' ') ++at;
      if (end - at < 3 || (at[0] != '-' && at[0] != '+') || at[2] != ' ') fail("size is damaged");
      if (at[1] != (side == 0 ? 'Y' : 'X')) fail("is stored by columns");
      (side == 0 ? upwards_ : leftwards_) = at[0] == (side == 0 ? '+' : '-');
      const auto result = std::from_chars(at + 3, end, sides[side]);
      if (result.ec != std::errc() || sides[side] == 0) fail("size is damaged");
      at = result.ptr;
    }
    checkSize(name_, sides[1], sides[0]);
    image_.width = static_cast<int>(sides[1]);
    image_.height = static_cast<int>(sides[0]);
    image_.channels = 3;
  }

  unsigned char byte() {
    if (at_ == bytes_.size()) cut();
    return bytes_[at_++];
  }

  void readRow(std::vector<unsigned char>& row) {
    const std::size_t pixels = row.size() / 4;
    if (pixels >= 8 && pixels < 32768 && at_ + 4 <= bytes_.size() && bytes_[at_] == 2 &&
        bytes_[at_ + 1] == 2 && bytes_[at_ + 2] < 128) {
      if (std::size_t(bytes_[at_ + 2]) << 8 != (pixels & 0xff00) ||
          bytes_[at_ + 3] != (pixels & 0xff)) {
        fail("rows are damaged");
      }
      at_ += 4;
      for (std::size_t c = 0; c < 4; ++c) readChannel(row, c);
    } else {
      readPixels(row);
    }
  }

  /// New run lengths, for one channel of a row; counts above 128 are runs.
  void readChannel(std::vector<unsigned char>& row, std::size_t channel) {
    for (std::size_t i = channel; i < row.size();) {
      std::size_t count = byte();
      const bool run = count > 128;
      if (run) count -= 128;
      if (count == 0 || count > (row.size() - i + 3) / 4) fail("runs are damaged");
      unsigned char value = run ? byte() : 0;
      for (; count > 0; --count, i += 4) row[i] = run ? value : byte();
    }
  }

  /// Plain pixels and old run lengths: (1, 1, 1, n) repeats the last pixel; a second such pixel in
  /// succession counts 256 times as much.
  void readPixels(std::vector<unsigned char>& row) {
    int shift = 0;
    for (std::size_t i = 0; i < row.size();) {
      unsigned char pixel[4];
      for (unsigned char& value : pixel) value = byte();
      if (pixel[0] != 1 || pixel[1] != 1 || pixel[2] != 1) {
        std::memcpy(&row[i], pixel, 4);
        i += 4;
        shift = 0;
        continue;
      }
      const std::size_t count = shift > 24 ? 0 : std::size_t(pixel[3]) << shift;
      if (i == 0 || shift > 24 || count > (row.size() - i) / 4) fail("runs are damaged");
      for (std::size_t n = 0; n < count; ++n, i += 4) std::memcpy(&row[i], &row[i - 4], 4);
      shift += 8;
    }
  }

  [[noreturn]] void fail(const char* what) const {
    throw damaged(name_, std::string("the HDR's ") + what);
  }
  [[noreturn]] void cut() const { throw damaged(name_, "the HDR is truncated"); }

  std::span<const unsigned char> bytes_;
  const std::string& name_;
  std::size_t at_ = 0;
  bool upwards_ = false, leftwards_ = false;
  StoredImage image_;
};

}  // namespace

bool isHdr(std::span<const std::byte> bytes) {
  for (const std::string_view magic : {"#?RADIANCE", "#?RGBE"}) {
    if (bytes.size() > magic.size() && std::memcmp(bytes.data(), magic.data(), magic.size()) == 0)
      return true;
  }
  return false;
}

StoredImage decodeHdr(std::span<const std::byte> bytes, const std::string& name) {
  return HdrReader(bytes, name).read();
}

}  // namespace glint::detail
