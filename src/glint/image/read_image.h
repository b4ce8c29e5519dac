#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>

#include "glint/image/image.h"

namespace glint {

/// Reads a picture to linear light; the format is found by the file's first bytes.
///
/// PNG: all colour types and depths, text chunks. JPEG, WebP: as decodeTexture(). PPM and PGM
/// (binary), BMP, TGA, TIFF (its first page). Colours of all these are taken as sRGB whatever the
/// file says of its colour space (but for TIFF of floats, which is linear light), and are
/// premultiplied by the straight alpha of the file.
/// OpenEXR: scan lines and tiles, one part or several, any compression, half, float and integer
/// channels, luminance and chroma; string attributes. The picture is the display window; outside
/// the data window it is black and transparent. `layer` names a layer, either a part or a prefix
/// of channel names ("diffuse" of "diffuse.R"); empty is the main picture. Channels are R, G, B, A;
/// Y (without an X), or a single channel of any other name, is grey.
/// Radiance .hdr: plain, old and new run lengths; without a half: (128,128,128,129) is 1.0;
/// EXPOSURE is not applied; header variables become text.
/// PFM: both byte orders, "PF" and "Pf" (grey), values as they stand (NaN too), alpha 1; the
/// absolute value of its scale is not applied.
///
/// Throws InputError "PATH: what: what to do" for a file that cannot be read or is damaged or cut
/// short, for other formats, for a layer that is not there, and for more than 2^20 pixels a
/// side, 2^28 in all, or 2^27 of 16 bits or floats.
Image readImage(const std::string& path, const std::string& layer = "");

/// As long as it lives, pictures of more pixels are refused in this thread once their header is
/// read, with `advice` after the colon.
class PictureLimit {
 public:
  PictureLimit(std::uint64_t pixels, std::string advice);
  ~PictureLimit();
  PictureLimit(const PictureLimit&) = delete;
  PictureLimit& operator=(const PictureLimit&) = delete;

  std::uint64_t pixels() const { return pixels_; }
  const std::string& advice() const { return advice_; }

 private:
  std::uint64_t pixels_;
  std::string advice_;
  const PictureLimit* outer_;
};

/// The same from memory; `name` stands in the messages.
Image decodeImage(std::span<const std::byte> bytes, const std::string& name,
                  const std::string& layer = "");

/// What a PNG or an EXR says of itself (text chunks before its pixels, string attributes), without
/// decoding the picture; empty for other formats. The file is not noted as read (read_files.h): it
/// is asked whether it has to be made again.
/// Throws InputError "PATH: what: what to do" if the file cannot be read or is damaged.
std::map<std::string, std::string> readPictureText(const std::string& path);

/// Whether the bytes begin as one of the formats that readPictureText() reads texts of.
bool mayHoldText(std::span<const std::byte> bytes);
std::map<std::string, std::string> pictureTextIn(std::span<const std::byte> bytes,
                                                 const std::string& name);

}  // namespace glint
