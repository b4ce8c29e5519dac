#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>

#include "glint/image/image.h"

namespace glint {

/// Reads a picture into linear light; the file's first bytes determine the format.
///
/// PNG: all colour types and depths, text chunks. JPEG, WebP: as decodeTexture(). PPM and PGM
/// (binary), BMP, TGA, TIFF (first page only). Colours in all these are taken as sRGB whatever
/// colour space the file declares (except for floating-point TIFF, which is linear light), and are
/// premultiplied by the file's straight alpha.
/// OpenEXR: scan lines and tiles, one part or several, any compression, half, float and integer
/// channels, luminance and chroma; string attributes. The picture is the display window; outside
/// the data window it is black and transparent. `layer` names a layer, either a part or a prefix of
/// channel names ("diffuse" for "diffuse.R"); empty means the main picture. Channels are R, G, B,
/// A; Y (without an X), or a single channel of any other name, is grey.
/// Radiance .hdr: plain, old and new run lengths; no half is added: (128,128,128,129) is 1.0;
/// EXPOSURE is not applied; header variables become text.
/// PFM: both byte orders, "PF" and "Pf" (grey), values unchanged (including NaN), alpha 1; the
/// absolute value of its scale is not applied.
///
/// Throws InputError "PATH: what: what to do" if the file cannot be read, is damaged or truncated,
/// for other formats, for a layer that does not exist, and for more than 2^20 pixels a side, 2^28
/// in all, or 2^27 with 16 bits or floats.
Image readImage(const std::string& path, const std::string& layer = "");

/// During its lifetime, pictures of more pixels are refused in this thread as soon as their header
/// has been read, with `advice` after the colon.
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

/// The same from memory; `name` appears in the messages.
Image decodeImage(std::span<const std::byte> bytes, const std::string& name,
                  const std::string& layer = "");

/// The metadata text of a PNG or an EXR (text chunks before its pixels, string attributes), read
/// without decoding the picture; empty for other formats. The file is not recorded as read
/// (read_files.h), since this decides whether it must be written again.
/// Throws InputError "PATH: what: what to do" if the file cannot be read or is damaged.
std::map<std::string, std::string> readPictureText(const std::string& path);

/// Whether the bytes start like a format from which readPictureText() can read text.
bool mayHoldText(std::span<const std::byte> bytes);
std::map<std::string, std::string> pictureTextIn(std::span<const std::byte> bytes,
                                                 const std::string& name);

}  // namespace glint
