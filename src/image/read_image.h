#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "glint/image/image.h"

namespace glint {

/// Reads a picture to linear light; the format is told by the file's first bytes.
///
/// PNG: all colour types and depths. Colours are taken as sRGB whatever the file says of its colour
/// space, and are premultiplied by the straight alpha of the file. PFM: both byte orders, "PF" and
/// "Pf" (grey), values as they stand (NaN too), alpha 1; the absolute value of its scale is not
/// applied.
///
/// Throws InputError "PATH: what: what to do" for a file that cannot be read or is damaged or cut
/// short, for other formats, and for more than 16384 pixels a side or 2^27 in all.
Image readImage(const std::string& path);

/// The same from memory; `name` stands in the messages.
Image decodeImage(std::span<const std::byte> bytes, const std::string& name);

}  // namespace glint
