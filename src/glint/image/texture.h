#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace glint {

/// Pixels as in the file: rows from the top, RGBA interleaved, straight alpha, encoded as in the
/// file (sRGB for colours), nothing premultiplied.
struct ByteImage {
  int width = 0;
  int height = 0;
  int channels = 4;
  std::vector<std::uint8_t> values;  ///< 4 * width * height
};

/// Whether this build reads WebP.
bool canDecodeWebp();

/// What a picture's first bytes reveal, before memory is spent on its pixels.
struct TextureHeader {
  int width = 0;
  int height = 0;
  /// Peak bytes needed for decoding in addition to the result: the coefficients of a progressive
  /// JPEG, the whole of an interlaced PNG or a WebP. `reducedWork` applies if the picture is scaled
  /// down (see decodeTexture()).
  std::uint64_t work = 0, reducedWork = 0;
};

/// Reads only the header. Throws InputError as decodeTexture() does.
TextureHeader textureHeader(std::span<const std::byte> bytes, const std::string& name);

/// Decodes a PNG (all colour types and depths; 16-bit samples lose their lower 8 bits), a JPEG
/// (grey, YCbCr, RGB, CMYK and YCCK by the usual naive conversion) or, if canDecodeWebp(), a WebP;
/// the first bytes determine the format. `name` appears in the messages. Nothing is printed.
///
/// With `halvings` the picture is scaled down as rows are read (RowReducer); `isData`: its values
/// are numbers, not sRGB.
///
/// Throws InputError "NAME: what: what to do" for other formats, for damaged or truncated data, and
/// for more than 2^20 pixels a side or 2^28 in all.
ByteImage decodeTexture(std::span<const std::byte> bytes, const std::string& name, int halvings = 0,
                        bool isData = false);

}  // namespace glint
