#include <algorithm>
#include <climits>
#include <cstdint>
#include <memory>

#include "glint/image/decoders.h"
#include "glint/image/row_window.h"

// stb_image reads BMP and TGA; nothing else of it is compiled. It is not used for PPM and PGM
// because it handles neither their maximum value nor the byte order of 16 bits.
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_BMP
#define STBI_ONLY_TGA
#define STBI_NO_STDIO
#define STBI_NO_HDR
#define STBI_NO_LINEAR
#define STBI_MAX_DIMENSIONS (1 << 20)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wshadow"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

namespace glint::detail {
namespace {

unsigned at(std::span<const std::byte> bytes, std::size_t i) { return unsigned(bytes[i]); }

}  // namespace

bool isPnm(std::span<const std::byte> bytes) {
  return bytes.size() >= 3 && at(bytes, 0) == 'P' && at(bytes, 1) >= '1' && at(bytes, 1) <= '7' &&
         (at(bytes, 2) <= ' ' || at(bytes, 2) == '#');
}

bool isBmp(std::span<const std::byte> bytes) {
  return bytes.size() >= 26 && at(bytes, 0) == 'B' && at(bytes, 1) == 'M' && at(bytes, 15) == 0 &&
         at(bytes, 16) == 0;
}

bool isTga(std::span<const std::byte> bytes) {
  if (bytes.size() < 18) return false;
  const unsigned map = at(bytes, 1), kind = at(bytes, 2), bits = at(bytes, 16);
  const bool knownKind = (kind >= 1 && kind <= 3) || (kind >= 9 && kind <= 11);
  const bool knownBits = bits == 8 || bits == 15 || bits == 16 || bits == 24 || bits == 32;
  return map <= 1 && knownKind && (map == 1) == (kind == 1 || kind == 9) && knownBits &&
         (at(bytes, 12) | at(bytes, 13)) != 0 && (at(bytes, 14) | at(bytes, 15)) != 0 &&
         (at(bytes, 17) & 0xc0) == 0;
}

namespace {

/// Binary PPM or PGM: "P6" or "P5", width, height, the maximum value, one white space, the values
/// (Netpbm). A # begins a comment.
class PnmReader {
 public:
  PnmReader(std::span<const std::byte> bytes, const std::string& name)
      : bytes_(bytes), name_(name) {}

  StoredImage read(std::size_t heldBytes) {
    if (at(bytes_, 1) != '5' && at(bytes_, 1) != '6') {
      throw InputError(
          printablePath(name_) +
          ": this kind of PNM is not supported: save it as binary PPM (P6) or PGM (P5)");
    }
    const int samples = at(bytes_, 1) == '6' ? 3 : 1;
    const std::uint32_t width = number(), height = number(), largest = number();
    if (width == 0 || height == 0 || largest == 0 || largest > 65535) fail();
    checkSides(name_, width, height);
    ++at_;
    const int size = largest > 255 ? 2 : 1;
    const std::uint64_t values = std::uint64_t(width) * height * samples;
    if (at_ > bytes_.size() || bytes_.size() - at_ < values * size)
      throw damaged(name_, "the PPM is truncated");
    StoredImage image{int(width), int(height), 3, {}};
    if (size == 2) {
      checkSize(name_, width, height);
      read<std::uint16_t>(samples, largest, heldBytes, image);
    } else {
      read<std::uint8_t>(samples, largest, heldBytes, image);
    }
    return image;
  }

 private:
  std::uint32_t number() {
    while (at_ < bytes_.size() && (at(bytes_, at_) <= ' ' || at(bytes_, at_) == '#')) {
      if (at(bytes_, at_) == '#')
        while (at_ < bytes_.size() && at(bytes_, at_) != '\n') ++at_;
      else
        ++at_;
    }
    std::uint64_t value = 0;
    const std::size_t begin = at_;
    for (; at_ < bytes_.size() && at(bytes_, at_) >= '0' && at(bytes_, at_) <= '9'; ++at_)
      value = std::min<std::uint64_t>(value * 10 + at(bytes_, at_) - '0', UINT32_MAX);
    if (at_ == begin) fail();
    return std::uint32_t(value);
  }

  template <class Code>
  void read(int samples, std::uint32_t largest, std::size_t heldBytes, StoredImage& image) const {
    const auto pixels = bytes_.subspan(at_);
    const std::size_t row = std::size_t(3) * image.width;
    const auto rowOf = [=, width = image.width](int y, Code* out) {
      constexpr std::uint32_t most = static_cast<Code>(-1);
      std::size_t from = std::size_t(y) * width * std::size_t(samples) * sizeof(Code);
      for (std::size_t i = 0; i < row; i += std::size_t(3 / samples)) {
        std::uint32_t value = 0;
        for (std::size_t k = 0; k < sizeof(Code); ++k) value = value << 8 | at(pixels, from++);
        value = std::min(value, largest);
        const auto code = static_cast<Code>((value * most + largest / 2) / largest);
        std::fill_n(out + i, 3 / samples, code);
      }
    };
    auto& codes = image.values.emplace<std::vector<Code>>();
    if (row * image.height * sizeof(Code) > heldBytes) {
      const auto start = [rowOf]() -> RowWindow::Next {
        return [rowOf, y = 0](std::byte* out) mutable { rowOf(y++, reinterpret_cast<Code*>(out)); };
      };
      image.window = std::make_shared<RowWindow>(row * sizeof(Code), image.height, start);
      return;
    }
    codes.resize(row * image.height);
    for (int y = 0; y < image.height; ++y) rowOf(y, codes.data() + row * y);
  }

  [[noreturn]] void fail() const { throw damaged(name_, "the PPM's header is damaged"); }

  std::span<const std::byte> bytes_;
  const std::string& name_;
  std::size_t at_ = 2;
};

}  // namespace

namespace {

std::uint64_t littleEndianAt(std::span<const std::byte> bytes, std::size_t i, int size) {
  std::uint64_t value = 0;
  for (int k = size; k-- > 0;)
    value = value << 8 | (i + k < bytes.size() ? at(bytes, i + std::size_t(k)) : 255u);
  return value;
}

/// The minimum length of a BMP or TGA of this size.
std::uint64_t leastBytes(std::span<const std::byte> bytes, std::uint64_t width,
                         std::uint64_t height) {
  if (isBmp(bytes)) {
    const std::uint64_t bits =
        littleEndianAt(bytes, littleEndianAt(bytes, 14, 4) == 12 ? 24 : 28, 2);
    const std::uint64_t row = (width * bits + 7) / 8, padded = (row + 3) / 4 * 4;
    return littleEndianAt(bytes, 10, 4) + padded * (height - 1) + row;
  }
  const std::uint64_t before =
      18 + littleEndianAt(bytes, 0, 1) +
      littleEndianAt(bytes, 5, 2) * ((littleEndianAt(bytes, 7, 1) + 7) / 8);
  const std::uint64_t pixel = (littleEndianAt(bytes, 16, 1) + 7) / 8;
  if (at(bytes, 2) < 9) return before + width * height * pixel;
  // Packets: a byte with count - 1 plus 128 for one repeated pixel; without the 128, count pixels.
  std::uint64_t place = before;
  for (std::uint64_t left = width * height; left > 0 && place < bytes.size();) {
    const unsigned head = at(bytes, std::size_t(place));
    const std::uint64_t count = std::min<std::uint64_t>((head & 127) + 1, left);
    place += 1 + (head & 128 ? pixel : count * pixel);
    left -= count;
    if (left > 0 && place >= bytes.size()) return place + 1;
  }
  return std::max(place, before + 1);
}

}  // namespace

StoredImage decodeSimple(std::span<const std::byte> bytes, const std::string& name,
                         std::size_t heldBytes) {
  if (isPnm(bytes)) return PnmReader(bytes, name).read(heldBytes);
  const char* const format = isBmp(bytes) ? "BMP" : "TGA";
  const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
  if (bytes.size() > INT_MAX)
    throw InputError(printablePath(name) + ": the file is too large: convert it to PNG");
  const int size = int(bytes.size());
  int width = 0, height = 0, channels = 0;
  const auto check = [&](bool good) {
    if (!good)
      throw damaged(name,
                    std::string("the ") + format + " is damaged (" + stbi_failure_reason() + ")");
  };
  check(stbi_info_from_memory(data, size, &width, &height, &channels) == 1);
  checkSides(name, std::uint64_t(width), std::uint64_t(height));
  // The library fills missing data with black.
  if (bytes.size() < leastBytes(bytes, std::uint64_t(width), std::uint64_t(height)))
    throw damaged(name, std::string("the ") + format + " is truncated");
  StoredImage image{width, height, channels == 2 || channels == 4 ? 4 : 3, {}};
  const std::unique_ptr<stbi_uc, void (*)(void*)> read(
      stbi_load_from_memory(data, size, &width, &height, &channels, image.channels),
      stbi_image_free);
  check(read != nullptr);
  const std::size_t pixels = std::size_t(width) * std::size_t(height);
  image.values.emplace<0>(read.get(), read.get() + std::size_t(image.channels) * pixels);
  return image;
}

}  // namespace glint::detail
