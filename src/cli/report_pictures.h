#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "glint/image/picture_layers.h"

namespace glint {

/// A layer as a browser can show it: the file itself if it is a PNG, JPEG or WebP, otherwise a PNG.
/// Layers that are not colours become greys, from black for the low end of the range to white for
/// the high end.
std::vector<std::byte> browserPicture(std::span<const std::byte> file, const PictureLayer& layer,
                                      std::pair<float, float> range);

/// The values of a picture of 16 bits or floats, for the page to show: a line of JSON (width,
/// height, channels, linear, colour), a line feed, and the values as 32-bit little-endian floats,
/// deflated (zlib). Empty for 8 bits and for more than 2^22 pixels.
std::vector<std::byte> trueValues(const PictureLayer& layer);

/// A small preview as PNG.
std::vector<std::byte> thumbnailOf(const StoredImage& image);

}  // namespace glint
