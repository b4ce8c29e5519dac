#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <memory>
#include <mutex>
#include <string_view>
#include <type_traits>

#include "glint/image/decoders.h"
#include "glint/image/row_window.h"

#if GLINT_TIFF
#include <tiffio.h>
#endif

namespace glint::detail {

bool isTiff(std::span<const std::byte> bytes) {
  const auto is = [&](char a, char b, char c, char d) {
    const char magic[] = {a, b, c, d};
    return bytes.size() >= 8 && std::memcmp(bytes.data(), magic, 4) == 0;
  };
  return is('I', 'I', '*', 0) || is('M', 'M', 0, '*') || is('I', 'I', '+', 0) ||
         is('M', 'M', 0, '+');
}

#if GLINT_TIFF
namespace {

/// The file in memory, as the library reads it, and the library's last error message.
struct Memory {
  std::span<const std::byte> bytes;
  std::uint64_t at = 0;
  std::string complaint;
};

Memory& memoryOf(thandle_t handle) { return *static_cast<Memory*>(handle); }

tsize_t readBytes(thandle_t handle, void* out, tsize_t size) {
  Memory& memory = memoryOf(handle);
  if (size <= 0 || memory.at >= memory.bytes.size()) return 0;
  const auto count = std::min<std::uint64_t>(std::uint64_t(size), memory.bytes.size() - memory.at);
  std::memcpy(out, memory.bytes.data() + memory.at, count);
  memory.at += count;
  return tsize_t(count);
}

tsize_t writeNothing(thandle_t, void*, tsize_t) { return 0; }

toff_t seek(thandle_t handle, toff_t offset, int whence) {
  Memory& memory = memoryOf(handle);
  memory.at = whence == SEEK_SET   ? offset
              : whence == SEEK_CUR ? memory.at + offset
                                   : memory.bytes.size() + offset;
  return memory.at;
}

int closeNothing(thandle_t) { return 0; }
toff_t sizeOf(thandle_t handle) { return memoryOf(handle).bytes.size(); }

void complain(thandle_t handle, const char*, const char* format, va_list arguments) {
  if (!handle) return;
  char text[200];
  std::vsnprintf(text, sizeof text, format, arguments);
  memoryOf(handle).complaint = text;
}

class TiffReader {
 public:
  TiffReader(std::span<const std::byte> bytes, const std::string& name)
      : memory_{bytes, 0, {}}, name_(name), file_(nullptr, TIFFClose) {
    // The library's handlers are global: silence them, except for the per-handle one.
    static std::once_flag once;
    std::call_once(once, [] {
      TIFFSetErrorHandler(nullptr);
      TIFFSetWarningHandler(nullptr);
      TIFFSetErrorHandlerExt(complain);
    });
    file_.reset(TIFFClientOpen("picture", "rm", &memory_, readBytes, writeNothing, seek,
                               closeNothing, sizeOf, nullptr, nullptr));
    if (!file_) fail();
  }

  StoredImage read(std::vector<std::string>& skipped, std::size_t heldBytes) {
    std::uint32_t width = 0, height = 0;
    if (!TIFFGetField(file_.get(), TIFFTAG_IMAGEWIDTH, &width) ||
        !TIFFGetField(file_.get(), TIFFTAG_IMAGELENGTH, &height) || width == 0 || height == 0)
      fail();
    checkSides(name_, width, height);
    const auto field = [&](ttag_t tag, std::uint16_t value) {
      TIFFGetFieldDefaulted(file_.get(), tag, &value);
      return value;
    };
    const int bits = field(TIFFTAG_BITSPERSAMPLE, 1), samples = field(TIFFTAG_SAMPLESPERPIXEL, 1);
    const int format = field(TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_UINT);
    const int photometric = field(TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
    const bool plain = field(TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG) == PLANARCONFIG_CONTIG &&
                       (photometric == PHOTOMETRIC_MINISBLACK || photometric == PHOTOMETRIC_RGB) &&
                       samples <= 4;
    image_ = {int(width), int(height), samples == 2 || samples == 4 ? 4 : 3, {}};
    if (plain && bits == 32 && format == SAMPLEFORMAT_IEEEFP) {
      checkSize(name_, width, height);
      readRows<float>(samples, heldBytes);
    } else if (plain && bits == 16 && format == SAMPLEFORMAT_UINT) {
      checkSize(name_, width, height);
      readRows<std::uint16_t>(samples, heldBytes);
    } else if (plain && bits == 8 && format == SAMPLEFORMAT_UINT) {
      readRows<std::uint8_t>(samples, heldBytes);
    } else if (bits <= 8) {
      readAsRgba();
    } else {
      throw InputError(
          printablePath(name_) + ": a TIFF of " + std::to_string(bits) +
          " bits in this layout is not supported: save it as 8 or 16 bits or 32-bit float, RGB or "
          "grey, not planar");
    }
    if (const int way = field(TIFFTAG_ORIENTATION, 1); way != 1)
      image_.unfollowed["EXIF orientation"] = std::to_string(way);
    std::uint32_t size = 0;
    const void* profile = nullptr;
    if (TIFFGetField(file_.get(), TIFFTAG_ICCPROFILE, &size, &profile) &&
        std::string_view(static_cast<const char*>(profile), size).find("sRGB") ==
            std::string_view::npos)
      image_.unfollowed["ICC profile"] = "";
    if (!TIFFLastDirectory(file_.get())) skipped.push_back("the pages after the first");
    return std::move(image_);
  }

  /// Reads row y of a strip image; rows must be read in order.
  template <class Value>
  void readRow(int y, int samples, int width, int channels, Value* out) {
    row_.resize(std::size_t(samples) * width * sizeof(Value));
    if (TIFFReadScanline(file_.get(), row_.data(), std::uint32_t(y), 0) != 1) fail();
    unpack(row_.data(), width, samples, channels, out);
  }

 private:
  /// Expands pixels as stored in the file to 3 or 4 channels.
  template <class Value>
  void unpack(const std::byte* bytes, int pixels, int samples, int channels, Value* out) {
    const Value* in = reinterpret_cast<const Value*>(bytes);
    Value* const begin = out;
    for (int x = 0; x < pixels; ++x, in += samples) {
      for (int c = 0; c < 3; ++c) *out++ = in[samples < 3 ? 0 : c];
      if (channels == 4) *out++ = in[samples - 1];
    }
    if constexpr (!std::is_same_v<Value, float>)
      if (channels == 4 && isAssociated()) divideByAlpha(begin, std::size_t(pixels));
  }

  template <class Value>
  void readTiles(int samples) {
    std::uint32_t across = 0, down = 0;
    if (!TIFFGetField(file_.get(), TIFFTAG_TILEWIDTH, &across) ||
        !TIFFGetField(file_.get(), TIFFTAG_TILELENGTH, &down) || across == 0 || down == 0)
      fail();
    checkSize(name_, across, down);
    const std::size_t tileRow = std::size_t(samples) * across * sizeof(Value);
    if (std::size_t(TIFFTileSize(file_.get())) != tileRow * down) fail();
    std::vector<std::byte> tile(tileRow * down);
    auto& values = image_.values.emplace<std::vector<Value>>();
    const auto width = std::uint32_t(image_.width), height = std::uint32_t(image_.height);
    const std::size_t channels = std::size_t(image_.channels), row = channels * width;
    for (std::uint32_t top = 0; top < height; top += down) {
      const std::uint32_t rows = std::min(down, height - top);
      values.resize(row * (top + rows));
      for (std::uint32_t left = 0; left < width; left += across) {
        if (TIFFReadTile(file_.get(), tile.data(), left, top, 0, 0) < 0) fail();
        for (std::uint32_t y = 0; y < rows; ++y)
          unpack(&tile[tileRow * y], int(std::min(across, width - left)), samples, int(channels),
                 &values[row * (top + y) + channels * left]);
      }
    }
  }

  template <class Value>
  void readRows(int samples, std::size_t heldBytes) {
    if (TIFFIsTiled(file_.get())) return readTiles<Value>(samples);
    auto& values = image_.values.emplace<std::vector<Value>>();
    const int width = image_.width, channels = image_.channels;
    if (std::size_t(TIFFScanlineSize(file_.get())) != std::size_t(samples) * width * sizeof(Value))
      fail();
    const std::size_t size = std::size_t(channels) * width;
    if (!std::is_same_v<Value, float> && size * image_.height * sizeof(Value) > heldBytes) {
      const auto start = [=, bytes = memory_.bytes, name = name_]() -> RowWindow::Next {
        const auto again = std::make_shared<TiffReader>(bytes, name);
        return [=, y = 0](std::byte* out) mutable {
          again->readRow(y++, samples, width, channels, reinterpret_cast<Value*>(out));
        };
      };
      image_.window = std::make_shared<RowWindow>(size * sizeof(Value), image_.height, start);
      return;
    }
    // Grown as rows arrive, so that a small file that claims to be huge uses little memory.
    for (int y = 0; y < image_.height; ++y) {
      values.resize(values.size() + size);
      readRow(y, samples, width, channels, values.data() + size * y);
    }
  }

  bool isAssociated() const {
    std::uint16_t count = 0;
    const std::uint16_t* kinds = nullptr;
    return TIFFGetField(file_.get(), TIFFTAG_EXTRASAMPLES, &count, &kinds) && count > 0 &&
           kinds[0] == EXTRASAMPLE_ASSOCALPHA;
  }

  /// Codes are straight everywhere else in the program.
  template <class Code>
  static void divideByAlpha(Code* codes, std::size_t pixels) {
    constexpr std::uint32_t most = static_cast<Code>(-1);
    for (std::size_t i = 0; i < 4 * pixels; i += 4) {
      const std::uint32_t alpha = codes[i + 3];
      for (std::size_t c = 0; c < 3 && alpha > 0; ++c)
        codes[i + c] = static_cast<Code>(std::min(most, (codes[i + c] * most + alpha / 2) / alpha));
    }
  }

  /// Palettes, YCbCr, planes: by the library's own conversion, which premultiplies by alpha.
  void readAsRgba() {
    std::vector<std::uint32_t> pixels(std::size_t(image_.width) * image_.height);
    if (TIFFReadRGBAImageOriented(file_.get(), std::uint32_t(image_.width),
                                  std::uint32_t(image_.height), pixels.data(), ORIENTATION_TOPLEFT,
                                  1) != 1)
      fail();
    image_.channels = 4;
    auto& codes = image_.values.emplace<0>();
    codes.reserve(pixels.size() * 4);
    for (const std::uint32_t pixel : pixels)
      for (const int shift : {0, 8, 16, 24}) codes.push_back(std::uint8_t(pixel >> shift));
    divideByAlpha(codes.data(), pixels.size());
  }

  [[noreturn]] void fail() const {
    throw damaged(name_, "the TIFF is damaged (" +
                             (memory_.complaint.empty() ? std::string("truncated")
                                                        : printablePath(memory_.complaint)) +
                             ")");
  }

  Memory memory_;
  const std::string name_;
  std::vector<std::byte> row_;
  std::unique_ptr<TIFF, void (*)(TIFF*)> file_;
  StoredImage image_;
};

}  // namespace

StoredImage decodeTiff(std::span<const std::byte> bytes, const std::string& name,
                       std::vector<std::string>& skipped, std::size_t heldBytes) {
  return TiffReader(bytes, name).read(skipped, heldBytes);
}
#else
StoredImage decodeTiff(std::span<const std::byte>, const std::string& name,
                       std::vector<std::string>&, std::size_t) {
  throw InputError(printablePath(name) + ": this build cannot read TIFF: convert it to PNG or EXR");
}
#endif

}  // namespace glint::detail
