#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace glint {

/// Makes text from a file or a command line fit for one line on a terminal: control characters,
/// bytes that are not UTF-8 and bidirectional control characters are escaped as "\n", "\x1b",
/// "\u202e"; text longer than `limit` bytes ends in "...". Printable text is unchanged, so applying
/// this twice is harmless.
std::string printable(std::string_view text, std::size_t limit = std::string_view::npos);

}  // namespace glint
