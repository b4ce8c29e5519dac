#include <algorithm>
#include <bit>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstring>
#include <string_view>

#include "glint/image/decoders.h"

namespace glint::detail {
namespace {

/// The words of a PFM's header: "PF" or "Pf", width, height, scale.
class PfmHeader {
 public:
  PfmHeader(std::span<const std::byte> bytes, const std::string& name)
      : text_(reinterpret_cast<const char*>(bytes.data()), std::min(bytes.size(), limit)),
        name_(name) {
    channels = word() == "PF" ? 3 : 1;
    width = number<std::uint32_t>();
    height = number<std::uint32_t>();
    scale = number<double>();
    if (width == 0 || height == 0 || scale == 0 || !std::isfinite(scale)) fail();
  }

  int channels;
  std::uint32_t width;
  std::uint32_t height;
  double scale;
  std::size_t size = 0;  ///< bytes, including the one white space after the scale

 private:
  static constexpr std::size_t limit = 256;

  static bool isSpace(char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; }

  std::string_view word() {
    while (size < text_.size() && isSpace(text_[size])) ++size;
    const std::size_t begin = size;
    while (size < text_.size() && !isSpace(text_[size])) ++size;
    if (size == text_.size()) fail();
    return text_.substr(begin, size++ - begin);
  }

  template <class Number>
  Number number() {
    const std::string_view digits = word();
    Number value{};
    const char* end = digits.data() + digits.size();
    const auto result = std::from_chars(digits.data(), end, value);
    if (result.ec != std::errc() || result.ptr != end) fail();
    return value;
  }

  [[noreturn]] void fail() const { throw damaged(name_, "the PFM's header is damaged"); }

  std::string_view text_;
  const std::string& name_;
};

float floatAt(const std::byte* bytes, bool swap) {
  std::uint32_t bits;
  std::memcpy(&bits, bytes, sizeof bits);
  return std::bit_cast<float>(swap ? __builtin_bswap32(bits) : bits);
}

}  // namespace

bool isPfm(std::span<const std::byte> bytes) {
  return bytes.size() >= 3 && bytes[0] == std::byte('P') &&
         (bytes[1] == std::byte('F') || bytes[1] == std::byte('f')) &&
         std::isspace(static_cast<int>(bytes[2])) != 0;
}

StoredImage decodePfm(std::span<const std::byte> bytes, const std::string& name) {
  const PfmHeader header(bytes, name);
  checkSides(name, header.width, header.height);
  const std::size_t rowBytes = std::size_t(4) * header.channels * header.width;
  if (bytes.size() - header.size < rowBytes * header.height) {
    throw damaged(name, "the PFM is truncated");
  }
  checkSize(name, header.width, header.height);
  StoredImage image;
  image.width = static_cast<int>(header.width);
  image.height = static_cast<int>(header.height);
  image.channels = 3;
  std::vector<float> values(std::size_t(3) * image.width * image.height);
  const bool swap = (header.scale < 0) != (std::endian::native == std::endian::little);
  float* out = values.data();
  for (int y = 0; y < image.height; ++y) {
    const std::byte* in = bytes.data() + header.size + rowBytes * (image.height - 1 - y);
    for (int x = 0; x < image.width; ++x) {
      for (int channel = 0; channel < 3; ++channel) {
        const int index = header.channels == 3 ? 3 * x + channel : x;
        *out++ = floatAt(in + std::size_t(4) * index, swap);
      }
    }
  }
  image.values = std::move(values);
  return image;
}

}  // namespace glint::detail
