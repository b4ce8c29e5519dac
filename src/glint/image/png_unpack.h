#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace glint::detail {

/// Decodes a whole PNG of 8-bit RGB or RGBA (as `channels` says) without interlacing into codes as
/// they are stored: what nearly all pictures of tests are, in a third of the time of the library
/// that reads all the others. False, with `codes` in any state, if there is anything about the file
/// that this does not know or that is wrong: the library then says what.
bool unpackPng(std::span<const std::byte> png, int width, int height, int channels,
               std::vector<std::uint8_t>& codes);

}  // namespace glint::detail
