#include <spng.h>

#include <algorithm>
#include <array>
#include <new>

#include "glint/image/decoders.h"
#include "glint/image/png_unpack.h"

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
