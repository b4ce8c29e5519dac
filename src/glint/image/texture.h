#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace glint {

/// Pixels as a file has them: rows from the top, RGBA interleaved, straight alpha, encoded as in
/// the file (sRGB for colours), nothing premultiplied.
struct ByteImage {
  int width = 0;
  int height = 0;
  int channels = 4;
  std::vector<std::uint8_t> values;  ///< 4 * width * height
};

/// Whether this build reads WebP.
bool canDecodeWebp();

/// What the first bytes of a picture say of it, before memory is spent on its pixels.
struct TextureHeader {
  int width = 0;
  int height = 0;
  /// Bytes that decoding needs at a time beside what it gives: the coefficients of a progressive
  /// JPEG, the whole of an interlaced PNG or a WebP. Where it is made smaller (see
  /// decodeTexture()), `reducedWork`.
  std::uint64_t work = 0, reducedWork = 0;
};

/// Reads no further than the header. Throws InputError as decodeTexture() does.
TextureHeader textureHeader(std::span<const std::byte> bytes, const std::string& name);

/// Decodes a PNG (all colour types and depths; 16 bits lose the lower 8) or a JPEG (grey, YCbCr,
/// RGB, CMYK and YCCK by the usual naive conversion); or a WebP,
/// where canDecodeWebp(); the format is found by the first bytes. `name`
/// stands in the messages. Nothing is printed.
///
/// With `halvings` it is made smaller as rows are read (RowReducer); `isData`: its values are
/// numbers and not sRGB.
///
/// Throws InputError "NAME: what: what to do" for other formats, for data that are damaged or cut
/// short, and for more than 2^20 pixels a side or 2^28 in all.
ByteImage decodeTexture(std::span<const std::byte> bytes, const std::string& name, int halvings = 0,
                        bool isData = false);

}  // namespace glint
