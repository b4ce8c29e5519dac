#include "glint/image/read_image.h"

#include <algorithm>
#include <bit>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstring>
#include <new>
#include <string_view>

#include "glint/image/decoders.h"
#include "glint/image/srgb.h"

namespace glint {
namespace {

constexpr std::size_t maxPixels = std::size_t(1) << 27;  // 2 GiB of floats

Image makeImage(const std::string& name, std::uint64_t width, std::uint64_t height) {
  detail::checkSides(name, width, height);
  if (width * height > maxPixels) {
    throw InputError(printablePath(name) + ": " + std::to_string(width) + " x " +
                     std::to_string(height) + " pixels are too many: give a smaller picture");
  }
  Image image{static_cast<int>(width), static_cast<int>(height), {}};
  image.values.resize(std::size_t(4) * width * height);
  return image;
}

/// To linear light by a table of all codes, premultiplied.
template <class Code>
void decodeCodes(const std::vector<Code>& codes, const float* linear, float maxCode,
                 std::vector<float>& values) {
  for (std::size_t i = 0; i < codes.size(); i += 4) {
    const float alpha = codes[i + 3] / maxCode;
    for (std::size_t channel = 0; channel < 3; ++channel) {
      values[i + channel] = linear[codes[i + channel]] * alpha;
    }
    values[i + 3] = alpha;
  }
}

Image decodePng(std::span<const std::byte> bytes, const std::string& name) {
  detail::PngReader reader(bytes, name);
  Image image = makeImage(name, reader.width(), reader.height());
  if (reader.bitDepth() == 16) {
    std::vector<float> linear(65536);
    for (std::size_t i = 0; i < linear.size(); ++i) {
      linear[i] = decodeSrgb16(static_cast<std::uint16_t>(i));
    }
    std::vector<std::uint16_t> codes;
    reader.decode(codes);
    decodeCodes(codes, linear.data(), 65535, image.values);
  } else {
    std::vector<std::uint8_t> codes;
    reader.decode(codes);
    decodeCodes(codes, srgbDecoded.data(), 255, image.values);
  }
  return image;
}

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
  std::size_t size = 0;  ///< bytes, with the one white space after the scale

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

  [[noreturn]] void fail() const { throw detail::damaged(name_, "the PFM's header is damaged"); }

  std::string_view text_;
  const std::string& name_;
};

float floatAt(const std::byte* bytes, bool swap) {
  std::uint32_t bits;
  std::memcpy(&bits, bytes, sizeof bits);
  return std::bit_cast<float>(swap ? __builtin_bswap32(bits) : bits);
}

Image decodePfm(std::span<const std::byte> bytes, const std::string& name) {
  const PfmHeader header(bytes, name);
  detail::checkSides(name, header.width, header.height);
  const std::size_t rowBytes = std::size_t(4) * header.channels * header.width;
  if (bytes.size() - header.size < rowBytes * header.height) {
    throw detail::damaged(name, "the PFM is cut short");
  }
  Image image = makeImage(name, header.width, header.height);
  const bool swap = (header.scale < 0) != (std::endian::native == std::endian::little);
  for (int y = 0; y < image.height; ++y) {
    const std::byte* in = bytes.data() + header.size + rowBytes * (image.height - 1 - y);
    float* out = image.row(y);
    for (int x = 0; x < image.width; ++x) {
      for (int channel = 0; channel < 3; ++channel) {
        const int index = header.channels == 3 ? 3 * x + channel : x;
        out[4 * x + channel] = floatAt(in + std::size_t(4) * index, swap);
      }
      out[4 * x + 3] = 1;
    }
  }
  return image;
}

bool isPfm(std::span<const std::byte> bytes) {
  return bytes.size() >= 3 && bytes[0] == std::byte('P') &&
         (bytes[1] == std::byte('F') || bytes[1] == std::byte('f')) &&
         std::isspace(static_cast<int>(bytes[2])) != 0;
}

}  // namespace

Image decodeImage(std::span<const std::byte> bytes, const std::string& name) {
  try {
    if (detail::isPng(bytes)) return decodePng(bytes, name);
    if (isPfm(bytes)) return decodePfm(bytes, name);
  } catch (const std::bad_alloc&) {
    throw InputError(printablePath(name) + ": too large for the memory: give a smaller picture");
  }
  throw InputError(printablePath(name) + ": neither PNG nor PFM: convert it to one of them");
}

Image readImage(const std::string& path) { return decodeImage(readFile(path), path); }

}  // namespace glint
