#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace glint {

/// Text of a file or a command line made fit for one line on a terminal: control characters, bytes
/// that are not UTF-8 and marks that turn the direction of writing are shown escaped, "\n",
/// "\x1b", "\u202e"; what is longer than `limit` bytes ends in "...". What is printable stays, so
/// that text may pass through twice.
std::string printable(std::string_view text, std::size_t limit = std::string_view::npos);

}  // namespace glint
