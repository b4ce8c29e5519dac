#include "glint/image/code_picture.h"

#include <libdeflate.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <new>
#include <string_view>
#include <vector>

#include "glint/image/srgb.h"

namespace glint::detail {
namespace {

constexpr std::size_t mostHeld = std::size_t(64) << 20;

void putWord(std::byte* out, std::uint32_t value) {
  for (int i = 0; i < 4; ++i) out[i] = static_cast<std::byte>(value >> (24 - 8 * i) & 255);
}

/// Writes a chunk: length, type, data, and the CRC of type and data. `chunk` has room for length
/// and type before the data.
void writeChunk(OutputFile& file, std::string_view kind, std::span<std::byte> chunk) {
  putWord(chunk.data(), static_cast<std::uint32_t>(chunk.size() - 8));
  std::memcpy(chunk.data() + 4, kind.data(), 4);
  file.write(chunk);
  std::byte check[4];
  putWord(check, libdeflate_crc32(0, chunk.data() + 4, chunk.size() - 4));
  file.write(check);
}

}  // namespace

CodePicture::CodePicture(const std::string& path, int width, int height)
    : width_(width), height_(height), rows_(nullptr, std::free) {
  const PictureFormat* const format = path == "-" ? nullptr : pictureFormatOf(path);
  const bool png = path == "-" || (format && format->id == PictureFormat::Id::png);
  const std::size_t size = (std::size_t(3) * width + 1) * height;
  if (!png || size > mostHeld) {
    writer_ = openPictureWriter(path, width, height);
    return;
  }
  file_.emplace(path);
  // Zeroed pages cost nothing until they are written to.
  rows_.reset(static_cast<std::uint8_t*>(std::calloc(size, 1)));
  if (!rows_) throw std::bad_alloc();
}

std::uint8_t* CodePicture::held(int y) const {
  return rows_.get() + (std::size_t(3) * width_ + 1) * y;
}

void CodePicture::add(std::span<const std::uint8_t> rgb) {
  if (!writer_) {
    std::copy(rgb.begin(), rgb.end(), held(y_++) + 1);
    return;
  }
  Image row{width_, 1, std::vector<float>(std::size_t(4) * width_, 1.0f)};
  for (std::size_t x = 0; x < std::size_t(width_); ++x)
    for (std::size_t c = 0; c < 3; ++c) row.values[4 * x + c] = decodeSrgb8(rgb[3 * x + c]);
  writer_->write(row);
}

void CodePicture::addBlack() {
  if (writer_) {
    add(std::vector<std::uint8_t>(std::size_t(3) * width_));
  } else {
    ++y_;
  }
}

void CodePicture::finish() {
  if (writer_) {
    writer_->finish();
    return;
  }
  const std::size_t size = (std::size_t(3) * width_ + 1) * height_;
  const std::unique_ptr<libdeflate_compressor, void (*)(libdeflate_compressor*)> deflater(
      libdeflate_alloc_compressor(1), libdeflate_free_compressor);
  if (!deflater) throw std::bad_alloc();
  const std::size_t bound = libdeflate_zlib_compress_bound(deflater.get(), size);
  const std::unique_ptr<std::byte, void (*)(void*)> packed(
      static_cast<std::byte*>(std::malloc(bound + 8)), std::free);
  if (!packed) throw std::bad_alloc();
  const std::size_t length =
      libdeflate_zlib_compress(deflater.get(), rows_.get(), size, packed.get() + 8, bound);
  constexpr unsigned char signature[] = {137, 'P', 'N', 'G', '\r', '\n', 26, '\n'};
  file_->write(std::as_bytes(std::span(signature)));
  std::byte header[8 + 13]{};
  putWord(header + 8, static_cast<std::uint32_t>(width_));
  putWord(header + 12, static_cast<std::uint32_t>(height_));
  header[16] = std::byte(8);  // bits
  header[17] = std::byte(2);  // RGB
  writeChunk(*file_, "IHDR", header);
  std::byte perceptual[8 + 1]{};
  writeChunk(*file_, "sRGB", perceptual);
  writeChunk(*file_, "IDAT", {packed.get(), length + 8});
  std::byte end[8]{};
  writeChunk(*file_, "IEND", end);
  file_->commit();
}

}  // namespace glint::detail
