#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace glint::detail {

/// Decodes a whole PNG of 8-bit RGB or RGBA (as given by `channels`) without interlacing into codes
/// as stored. Nearly all test pictures are like that, and this takes a third of the time of the
/// library that reads all others. Returns false, leaving `codes` in an unspecified state, if the
/// file is damaged or has a feature unknown to this function; the library then reports what is
/// wrong.
bool unpackPng(std::span<const std::byte> png, int width, int height, int channels,
               std::vector<std::uint8_t>& codes);

}  // namespace glint::detail
