#include "glint/image/difference_picture.h"

#include <libdeflate.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>
#include <optional>
#include <string_view>
#include <vector>

#include "glint/image/compared_rows.h"
#include "glint/image/file.h"
#include "glint/image/picture_writer.h"
#include "glint/image/srgb.h"

namespace glint {
namespace {

std::uint8_t shownCode(float encoded) {
  const float code = std::clamp(std::isnan(encoded) ? 1.0f : encoded, 0.0f, 1.0f) * 255;
  return static_cast<std::uint8_t>(std::lround(code));
}

/// |a - b| for a row of 8-bit codes if all of it is opaque; otherwise false.
bool differencesOfCodes(const detail::ComparedRows& rows, int y, double scale,
                        std::vector<std::uint8_t>& shown) {
  if (!rows.comparesCodes() || rows.ignoresSome()) return false;
  std::array<std::uint8_t, 256> codes{};
  for (std::size_t i = 0; i < 256; ++i) codes[i] = shownCode(float(i) / 255 * float(scale));
  std::vector<std::uint8_t> copyA, copyB;
  const std::uint8_t *a = rows.codesA(y, copyA), *b = rows.codesB(y, copyB);
  const auto step = std::size_t(rows.codeChannels());
  std::uint8_t* out = shown.data();
  for (int x = 0; x < rows.width(); ++x, a += step, b += step, out += 3) {
    if (step == 4 && (a[3] & b[3]) != 255) return false;
    for (int c = 0; c < 3; ++c) out[c] = codes[std::size_t(std::abs(a[c] - b[c]))];
  }
  return true;
}

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

/// A picture of 8-bit sRGB codes, written row by row, that is mostly uniform, as differences are. A
/// PNG that is not large is held in memory and compressed in one piece, which takes a third of the
/// time. Formats and errors are those of openPictureWriter().
class CodePicture {
 public:
  CodePicture(const std::string& path, int width, int height);

  /// The next row: 3 * width codes.
  void add(std::span<const std::uint8_t> rgb);
  void addBlack();
  void finish();

 private:
  std::uint8_t* held(int y) const;

  const int width_, height_;
  int y_ = 0;
  std::unique_ptr<std::uint8_t[], void (*)(void*)> rows_;  ///< each row follows its filter byte
  std::optional<OutputFile> file_;                         ///< used if the picture is held
  std::unique_ptr<PictureWriter> writer_;                  ///< used otherwise
};

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

}  // namespace

struct FlipPicture::Parts {
  CodePicture picture;
  std::vector<std::uint8_t> row;
};

FlipPicture::FlipPicture(const std::string& path, int width, int height)
    : parts_(new Parts{{path, width, height}, std::vector<std::uint8_t>(std::size_t(3) * width)}) {}

FlipPicture::~FlipPicture() = default;

void FlipPicture::add(const float* errors) {
  std::vector<std::uint8_t>& row = parts_->row;
  std::array<std::uint8_t, 3> none{};
  magma(0, none.data());
  for (std::size_t i = 0; i < row.size(); i += 3, ++errors) {
    if (*errors > 0) {
      magma(*errors, &row[i]);
    } else {
      std::copy(none.begin(), none.end(), &row[i]);
    }
  }
  parts_->picture.add(row);
}

void FlipPicture::finish() { parts_->picture.finish(); }

void writeDifference(const std::string& path, const StoredImage& a, const StoredImage& b,
                     const CompareOptions& options, DifferenceKind kind, double scale) {
  if (a.width != b.width || a.height != b.height) {
    const int wide = std::max(a.width, b.width), high = std::max(a.height, b.height);
    CompareOptions all = options;
    all.mask = nullptr;
    writeDifference(path, padded(a, wide, high), padded(b, wide, high), all, kind, scale);
    return;
  }
  const detail::ComparedRows rows(a, b, options);
  if (kind == DifferenceKind::flip) {
    FlipPicture picture(path, rows.width(), rows.height());
    flip(rows.linearA(), rows.linearB(), options.flip,
         [&](int, const float* errors) { picture.add(errors); });
    picture.finish();
    return;
  }
  const int width = rows.width(), height = rows.height();
  const bool beside = kind == DifferenceKind::sideBySide;
  const std::size_t third = std::size_t(3) * width;
  CodePicture picture(path, beside ? 3 * width : width, height);
  std::vector<std::uint8_t> row(beside ? 3 * third : third);
  std::vector<float> va(std::size_t(4) * width), vb(va.size());
  std::vector<unsigned char> counts(std::size_t(width), 1);
  for (int y = 0; y < height; ++y) {
    if (!beside && !rows.ignoresSome() && rows.codesAreEqual(y)) {
      picture.addBlack();
      continue;
    }
    if (!beside && differencesOfCodes(rows, y, scale, row)) {
      picture.add(row);
      continue;
    }
    rows.encoded(y, va.data(), vb.data());
    if (rows.ignoresSome()) rows.counted(y, counts.data());
    for (std::size_t x = 0; x < counts.size(); ++x)
      for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t from = 4 * x + c, to = 3 * x + c;
        const float difference = std::fabs(va[from] - vb[from]) * float(scale);
        row[beside ? to + 2 * third : to] = shownCode(counts[x] ? difference : 0.5f);
        if (!beside) continue;
        row[to] = shownCode(va[from]);
        row[to + third] = shownCode(vb[from]);
      }
    picture.add(row);
  }
  picture.finish();
}

}  // namespace glint
