#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace glint {

/// A format of picture files. Their file name extensions are known only to this table.
struct PictureFormat {
  enum class Id { png, jpeg, webp, exr, pfm, raw, hdr, tiff, pnm, bmp, tga };
  Id id;
  std::string_view name;                    ///< "PNG"
  std::array<std::string_view, 2> endings;  ///< extensions in lower case, with the dot; or empty
  bool isWritten;
  bool isFloat;    ///< linear light in 32 bits, before exposure; otherwise sRGB codes
  bool hasAlpha;   ///< as written
  bool holdsText;  ///< can record how the picture was made
  bool needsFile;  ///< cannot be written sequentially, as a pipe requires
};

std::span<const PictureFormat> pictureFormats();
const PictureFormat& pictureFormat(PictureFormat::Id);

/// The format for a file name's extension, in upper or lower case; null if there is none.
const PictureFormat* pictureFormatOf(std::string_view path);

/// The readable format that a file's first bytes indicate; null if none.
const PictureFormat* pictureFormatIn(std::span<const std::byte> bytes);

/// The format with this name ("png", "jpeg") or extension without its dot ("jpg"); null if there is
/// none.
const PictureFormat* pictureFormatNamed(std::string_view name);

/// The extensions of the formats written: ".png, .jpg, .webp, .exr or .pfm".
std::string writtenEndings();

}  // namespace glint
