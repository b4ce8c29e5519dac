#pragma once

#include <string>

namespace glint {

/// What printf would print; at most 511 characters.
[[gnu::format(printf, 1, 2)]] std::string formatted(const char* format, ...);

/// Lines of at most `width` bytes, broken at spaces; a longer word gets a line of its own.
std::string wrapped(const std::string& text, std::size_t width);

}  // namespace glint
