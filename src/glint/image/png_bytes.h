#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace glint {

// Small PNG files in memory, for pages with embedded pictures. picture_writer.h writes pictures to
// files.

/// 8-bit sRGB: 3 * width * height codes, rows from the top.
std::vector<std::byte> pngOfRgb(std::span<const std::uint8_t> rgb, int width, int height);

/// The same with straight alpha: 4 * width * height codes.
std::vector<std::byte> pngOfRgba(std::span<const std::uint8_t> rgba, int width, int height);

/// width * height indices into a palette of at most 256 sRGB colours.
std::vector<std::byte> pngOfIndices(std::span<const std::uint8_t> indices, int width, int height,
                                    std::span<const std::array<std::uint8_t, 3>> palette);

}  // namespace glint
