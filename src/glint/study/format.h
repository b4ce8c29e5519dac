#pragma once

#include <string>

namespace glint {

/// What printf would print; at most 511 characters.
[[gnu::format(printf, 1, 2)]] std::string formatted(const char* format, ...);

}  // namespace glint
