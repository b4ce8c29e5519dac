#include <libdeflate.h>
#include <spng.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>
#include <string_view>

#include "glint/image/decoders.h"

namespace glint::detail {
namespace {

// Colour profiles and text are not needed here; a file with more of them than this is no picture.
constexpr std::size_t chunkLimit = std::size_t(32) << 20;

/// Samples per pixel as stored in the file.
std::uint64_t samplesOf(int colourType) {
  switch (colourType) {
    case SPNG_COLOR_TYPE_TRUECOLOR:
      return 3;
    case SPNG_COLOR_TYPE_GRAYSCALE_ALPHA:
      return 2;
    case SPNG_COLOR_TYPE_TRUECOLOR_ALPHA:
      return 4;
    default:
      return 1;
  }
}

std::string utf8OfLatin1(const std::string& latin) {
  std::string utf8;
  for (const char letter : latin) {
    const auto code = static_cast<unsigned char>(letter);
    if (code >= 0x80) utf8 += static_cast<char>(0xc0 | code >> 6);
    utf8 += static_cast<char>(code < 0x80 ? code : 0x80 | (code & 0x3f));
  }
  return utf8;
}

std::uint32_t bigEndian(const std::byte* p) {
  return std::uint32_t(p[0]) << 24 | std::uint32_t(p[1]) << 16 | std::uint32_t(p[2]) << 8 |
         std::uint32_t(p[3]);
}

/// Finds the compressed pixels of a PNG: sets `pixels`, concatenating several chunks in `joined`.
/// Returns false if a chunk is damaged or would change what the codes mean (tRNS).
bool gather(std::span<const std::byte> png, std::vector<std::byte>& joined,
            std::span<const std::byte>& pixels) {
  bool ended = false;
  for (std::size_t at = 8; !ended;) {
    if (png.size() - at < 12) return false;
    const std::size_t size = bigEndian(&png[at]);
    if (size > png.size() - at - 12) return false;
    const std::string_view kind(reinterpret_cast<const char*>(&png[at + 4]), 4);
    if (libdeflate_crc32(0, &png[at + 4], size + 4) != bigEndian(&png[at + 8 + size])) return false;
    const std::span<const std::byte> data = png.subspan(at + 8, size);
    if (kind == "tRNS") return false;
    if (kind == "IDAT") {
      // A single chunk is used in place.
      if (!pixels.empty() && joined.empty()) joined.assign(pixels.begin(), pixels.end());
      if (pixels.empty()) {
        pixels = data;
      } else {
        joined.insert(joined.end(), data.begin(), data.end());
      }
    }
    ended = kind == "IEND";
    at += size + 12;
  }
  if (!joined.empty()) pixels = joined;
  return !pixels.empty();
}

/// The PNG filter's Paeth predictor: left, above or upper left, whichever is nearest to
/// left + above - upper left.
inline int paeth(int a, int b, int c) {
  const int pa = std::abs(b - c), pb = std::abs(a - c), pc = std::abs(a + b - 2 * c);
  const int other = pb <= pc ? b : c;
  return pa <= pb && pa <= pc ? a : other;
}

/// Undoes the filter of one row (PNG, section 9.2). `above` is the previous row, or zeros.
template <int step>
bool unfilter(int filter, const std::uint8_t* __restrict in, const std::uint8_t* __restrict above,
              std::uint8_t* __restrict out, std::size_t size) {
  switch (filter) {
    case 0:
      std::memcpy(out, in, size);
      return true;
    case 1: {
      std::uint8_t left[step] = {};
      for (std::size_t i = 0; i < size; i += step)
        for (int c = 0; c < step; ++c)
          out[i + c] = left[c] = static_cast<std::uint8_t>(in[i + c] + left[c]);
      return true;
    }
    case 2:
      for (std::size_t i = 0; i < size; ++i) out[i] = static_cast<std::uint8_t>(in[i] + above[i]);
      return true;
    case 3: {
      std::uint8_t left[step] = {};
      for (std::size_t i = 0; i < size; i += step)
        for (int c = 0; c < step; ++c)
          out[i + c] = left[c] =
              static_cast<std::uint8_t>(in[i + c] + (left[c] + above[i + c]) / 2);
      return true;
    }
    case 4: {
      int left[step] = {}, corner[step] = {};
      for (std::size_t i = 0; i < size; i += step)
        for (int c = 0; c < step; ++c) {
          const int up = above[i + c];
          left[c] = (in[i + c] + paeth(left[c], up, corner[c])) & 255;
          corner[c] = up;
          out[i + c] = static_cast<std::uint8_t>(left[c]);
        }
      return true;
    }
    default:
      return false;
  }
}

/// Decodes a whole PNG of 8-bit RGB or RGBA (as given by `channels`) without interlacing into codes
/// as stored. Nearly all test pictures are like that, and this takes a third of the time of the
/// library that reads all others. Returns false, leaving `codes` in an unspecified state, if the
/// file is damaged or has a feature unknown to this function; the library then reports what is
/// wrong.
bool unpackPng(std::span<const std::byte> png, int width, int height, int channels,
               std::vector<std::uint8_t>& codes) {
  std::vector<std::byte> joined;
  std::span<const std::byte> pixels;
  if (!gather(png, joined, pixels)) return false;
  const std::size_t rowSize = std::size_t(channels) * width, size = (rowSize + 1) * height;
  const std::unique_ptr<libdeflate_decompressor, void (*)(libdeflate_decompressor*)> inflater(
      libdeflate_alloc_decompressor(), libdeflate_free_decompressor);
  // Fresh memory costs more than the work done in it, so rows are unfiltered in place, each through
  // a copy.
  codes.resize(size);
  if (!inflater || libdeflate_zlib_decompress(inflater.get(), pixels.data(), pixels.size(),
                                              codes.data(), size, nullptr) != LIBDEFLATE_SUCCESS)
    return false;
  std::vector<std::uint8_t> row(rowSize);
  const std::vector<std::uint8_t> zeros(rowSize);
  const std::uint8_t* above = zeros.data();
  for (int y = 0; y < height; ++y) {
    const std::uint8_t* in = codes.data() + (rowSize + 1) * y;
    std::uint8_t* out = codes.data() + rowSize * y;
    const int filter = in[0];
    std::memcpy(row.data(), in + 1, rowSize);
    if (!(channels == 3 ? unfilter<3>(filter, row.data(), above, out, rowSize)
                        : unfilter<4>(filter, row.data(), above, out, rowSize)))
      return false;
    above = out;
  }
  codes.resize(rowSize * height);
  return true;
}

}  // namespace

bool isPng(std::span<const std::byte> bytes) {
  constexpr std::array<unsigned char, 8> signature{137, 'P', 'N', 'G', '\r', '\n', 26, '\n'};
  return bytes.size() >= signature.size() &&
         std::equal(signature.begin(), signature.end(), bytes.begin(),
                    [](unsigned char a, std::byte b) { return std::byte(a) == b; });
}

PngReader::PngReader(std::span<const std::byte> bytes, const std::string& name)
    : bytes_(bytes), name_(name), png_(spng_ctx_new(0), spng_ctx_free) {
  if (!png_) throw std::bad_alloc();
  check(spng_set_crc_action(png_.get(), SPNG_CRC_ERROR, SPNG_CRC_DISCARD));
  check(spng_set_chunk_limits(png_.get(), chunkLimit, chunkLimit));
  check(spng_set_png_buffer(png_.get(), bytes.data(), bytes.size()));
  spng_ihdr header{};
  check(spng_get_ihdr(png_.get(), &header));
  checkSides(name, header.width, header.height);
  // Deflate expands a byte to at most 1032. This refuses a small file that claims to be huge before
  // memory is spent on it.
  const std::uint64_t bits = samplesOf(header.color_type) * header.bit_depth * header.width;
  if ((bits + 7) / 8 * header.height > bytes.size() * 1032)
    throw damaged(name, "the PNG is truncated");
  width_ = static_cast<int>(header.width);
  height_ = static_cast<int>(header.height);
  bitDepth_ = header.bit_depth;
  colourType_ = header.color_type;
  isInterlaced_ = header.interlace_method != SPNG_INTERLACE_NONE;
  isPlain_ = header.bit_depth == 8 && !isInterlaced_;
}

bool PngReader::hasAlpha() const {
  spng_trns transparent{};
  return colourType_ == SPNG_COLOR_TYPE_GRAYSCALE_ALPHA ||
         colourType_ == SPNG_COLOR_TYPE_TRUECOLOR_ALPHA ||
         spng_get_trns(png_.get(), &transparent) == 0;
}

void PngReader::decodeOpaque(std::vector<std::uint8_t>& rgb) {
  if (isPlain_ && colourType_ == SPNG_COLOR_TYPE_TRUECOLOR &&
      unpackPng(bytes_, width_, height_, 3, rgb))
    return;
  rgb.resize(std::size_t(3) * width_ * height_);
  decodeTo(rgb.data(), rgb.size(), SPNG_FMT_RGB8);
}

std::map<std::string, std::string> PngReader::text() {
  std::uint32_t count = 0;
  if (spng_get_text(png_.get(), nullptr, &count) != 0) return {};
  std::vector<spng_text> chunks(count);
  check(spng_get_text(png_.get(), chunks.data(), &count));
  std::map<std::string, std::string> text;
  for (const spng_text& chunk : chunks) {
    const std::string value(chunk.text, chunk.length);
    text[utf8OfLatin1(chunk.keyword)] = chunk.type == SPNG_ITXT ? value : utf8OfLatin1(value);
  }
  return text;
}

void PngReader::decode(std::vector<std::uint8_t>& rgba) {
  if (isPlain_ && colourType_ == SPNG_COLOR_TYPE_TRUECOLOR_ALPHA &&
      unpackPng(bytes_, width_, height_, 4, rgba))
    return;
  rgba.resize(std::size_t(4) * width_ * height_);
  decodeTo(rgba.data(), rgba.size(), SPNG_FMT_RGBA8);
}

void PngReader::decode(std::vector<std::uint16_t>& rgba) {
  rgba.resize(std::size_t(4) * width_ * height_);
  decodeTo(rgba.data(), rgba.size() * sizeof rgba[0], SPNG_FMT_RGBA16);
}

void PngReader::decodeRows(const std::function<void(const std::uint8_t* rgba)>& take) {
  const std::size_t rowBytes = std::size_t(4) * width_;
  if (isInterlaced_) {
    std::vector<std::uint8_t> rgba;
    decode(rgba);
    for (int y = 0; y < height_; ++y) take(rgba.data() + rowBytes * y);
    return;
  }
  std::vector<std::uint8_t> row(rowBytes);
  beginRows(4, 8);
  for (int y = 0; y < height_; ++y) {
    nextRow(reinterpret_cast<std::byte*>(row.data()));
    take(row.data());
  }
}

void PngReader::beginRows(int channels, int depth) {
  const int format = depth == 16 ? SPNG_FMT_RGBA16 : channels == 4 ? SPNG_FMT_RGBA8 : SPNG_FMT_RGB8;
  rowSize_ = std::size_t(channels) * width_ * (depth / 8);
  rowsLeft_ = height_;
  check(spng_decode_image(png_.get(), nullptr, 0, format,
                          SPNG_DECODE_TRNS | SPNG_DECODE_PROGRESSIVE));
}

void PngReader::nextRow(std::byte* row) {
  const int status = spng_decode_row(png_.get(), row, rowSize_);
  if (status != SPNG_EOI) check(status);
  if (--rowsLeft_ == 0) check(spng_decode_chunks(png_.get()));
}

void PngReader::decodeTo(void* out, std::size_t size, int format) {
  check(spng_decode_image(png_.get(), out, size, format, SPNG_DECODE_TRNS));
  check(spng_decode_chunks(png_.get()));  // to the end, to detect a truncated file
}

void PngReader::check(int status) const {
  if (status == 0) return;
  if (status == SPNG_EMEM) throw std::bad_alloc();
  throw damaged(name_, std::string("the PNG is damaged (") + spng_strerror(status) + ")");
}

}  // namespace glint::detail
