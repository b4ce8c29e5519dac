#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace glint {

/// A format of picture files. This table is the only place that knows their names' endings.
struct PictureFormat {
  enum class Id { png, jpeg, webp, exr, pfm, raw, hdr, tiff, pnm, bmp, tga };
  Id id;
  std::string_view name;                    ///< "PNG"
  std::array<std::string_view, 2> endings;  ///< of file names, lower case, with the dot; or empty
  bool isWritten;
  bool isFloat;    ///< linear light in 32 bits, before exposure; else sRGB codes
  bool hasAlpha;   ///< as it is written
  bool holdsText;  ///< says how the picture was made
  bool needsFile;  ///< is not written from its beginning to its end, as a pipe needs it
};

std::span<const PictureFormat> pictureFormats();
const PictureFormat& pictureFormat(PictureFormat::Id);

/// The format by the ending of a file's name, in upper or lower case; null if there is none.
const PictureFormat* pictureFormatOf(std::string_view path);

/// The format that the first bytes of a file are of, of those that are read; null if of none.
const PictureFormat* pictureFormatIn(std::span<const std::byte> bytes);

/// The format of this name ("png", "jpeg") or ending without its dot ("jpg"); null if there is
/// none.
const PictureFormat* pictureFormatNamed(std::string_view name);

/// The endings of what is written: ".png, .jpg, .webp, .exr or .pfm".
std::string writtenEndings();

}  // namespace glint
