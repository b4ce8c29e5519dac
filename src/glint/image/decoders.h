#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "glint/image/error.h"
#include "glint/image/file.h"
#include "glint/image/picture_layers.h"
#include "glint/image/stored_image.h"
#include "glint/image/texture.h"

struct spng_ctx;

namespace glint::detail {

constexpr int maxSide = 1 << 20;                           ///< pixels
constexpr std::uint64_t maxArea = std::uint64_t(1) << 28;  ///< pixels: 1 GiB of bytes

bool isPng(std::span<const std::byte> bytes);
bool isJpeg(std::span<const std::byte> bytes);
bool isWebp(std::span<const std::byte> bytes);
bool isPfm(std::span<const std::byte> bytes);
bool isHdr(std::span<const std::byte> bytes);
bool isExr(std::span<const std::byte> bytes);
bool isTiff(std::span<const std::byte> bytes);
/// PPM, PGM and the other binary Netpbm formats; BMP.
bool isPnm(std::span<const std::byte> bytes);
bool isBmp(std::span<const std::byte> bytes);
/// TGA has no magic number: this checks that the header is plausible. Try it last.
bool isTga(std::span<const std::byte> bytes);

/// Also throws InputError if the build has no libwebp.
ByteImage decodeWebp(std::span<const std::byte> bytes, const std::string& name);
TextureHeader webpHeader(std::span<const std::byte> bytes, const std::string& name);
/// `halvings` and `isData` as for decodeTexture().
ByteImage decodeJpeg(std::span<const std::byte> bytes, const std::string& name, int halvings = 0,
                     bool isData = false);
TextureHeader jpegHeader(std::span<const std::byte> bytes, const std::string& name);

StoredImage decodePfm(std::span<const std::byte> bytes, const std::string& name);
StoredImage decodeHdr(std::span<const std::byte> bytes, const std::string& name);
StoredImage decodeExr(std::span<const std::byte> bytes, const std::string& name,
                      const std::string& layer);
PictureLayers decodeExrLayers(std::span<const std::byte> bytes, const std::string& name,
                              const std::string& wanted);
/// PPM, PGM, BMP and TGA. PPM and PGM are read by rows if they would take more than `heldBytes`.
StoredImage decodeSimple(std::span<const std::byte> bytes, const std::string& name,
                         std::size_t heldBytes);
/// The first page; `skipped` receives a description of what else the file holds. Strips are read by
/// rows if they would take more than `heldBytes`.
StoredImage decodeTiff(std::span<const std::byte> bytes, const std::string& name,
                       std::vector<std::string>& skipped, std::size_t heldBytes);

/// What the metadata of a PNG, JPEG or WebP say about colours and orientation; see
/// StoredImage::unfollowed.
std::map<std::string, std::string> unfollowedIn(std::span<const std::byte> bytes);
/// The orientation in EXIF data (a TIFF header and its first directory); 1, as stored, if there is
/// none.
int exifOrientation(std::span<const std::byte> exif);

/// The string attributes of an EXR's first part; reads no pixels.
std::map<std::string, std::string> exrText(std::span<const std::byte> bytes,
                                           const std::string& name);

/// A PNG whose header has been read and whose size is allowed. `bytes` must outlive it.
class PngReader {
 public:
  PngReader(std::span<const std::byte> bytes, const std::string& name);

  int width() const { return width_; }
  int height() const { return height_; }
  int bitDepth() const { return bitDepth_; }  ///< of the file: 1, 2, 4, 8 or 16
  bool hasAlpha() const;                      ///< an alpha channel, or transparent colours
  bool isInterlaced() const { return isInterlaced_; }

  /// Straight RGBA, rows from the top: 4 * width * height values each.
  void decode(std::vector<std::uint8_t>& rgba);
  void decode(std::vector<std::uint16_t>& rgba);
  /// As decode() with 8 bits, row by row; the whole picture is held only if the file is interlaced.
  void decodeRows(const std::function<void(const std::uint8_t* rgba)>& take);
  /// The same one row at a time, for a file that is not interlaced: 8- or 16-bit RGBA, or 8-bit
  /// RGB.
  void beginRows(int channels, int depth);
  void nextRow(std::byte* row);
  /// RGB of 8 bits, for a file without alpha: 3 * width * height values.
  void decodeOpaque(std::vector<std::uint8_t>& rgb);
  /// The text chunks, in UTF-8. Once the picture has been decoded these are all of them; before
  /// that, only those ahead of the pixels, where the PNG writer puts them.
  std::map<std::string, std::string> text();

 private:
  void decodeTo(void* out, std::size_t size, int format);
  void check(int status) const;

  std::span<const std::byte> bytes_;
  std::string name_;
  std::unique_ptr<spng_ctx, void (*)(spng_ctx*)> png_;
  int width_ = 0;
  int height_ = 0;
  int bitDepth_ = 0;
  int colourType_ = 0;
  bool isInterlaced_ = false;
  std::size_t rowSize_ = 0;  ///< bytes per row for nextRow()
  int rowsLeft_ = 0;
  bool isPlain_ = false;  ///< 8 bits, rows in order
};

/// An error for data that no decoder can make sense of.
inline InputError damaged(const std::string& name, const std::string& what) {
  return InputError(printablePath(name) + ": " + what + ": save the picture again");
}

/// How much to reserve for a texture of this many bytes: a driver's copy, which includes the
/// smaller levels, then fits where an earlier texture was freed and touches no fresh memory. The
/// reserve beyond the pixels is not touched.
inline std::size_t withRoomForLevels(std::size_t bytes) { return bytes + bytes / 3 + (1 << 16); }

/// Throws InputError if there are more pixels than may be read as 16 bits or floats, or if a side
/// is longer than maxSide.
void checkSize(const std::string& name, std::uint64_t width, std::uint64_t height);

/// Throws InputError if a side is longer than maxSide, or there are more than maxArea pixels.
void checkSides(const std::string& name, std::uint64_t width, std::uint64_t height);

}  // namespace glint::detail
