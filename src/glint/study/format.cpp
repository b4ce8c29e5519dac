#include "glint/study/format.h"

#include <algorithm>
#include <cstdarg>
#include <cstdio>

namespace glint {

std::string formatted(const char* format, ...) {
  char buffer[512];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(buffer, sizeof buffer, format, arguments);
  va_end(arguments);
  return buffer;
}

std::string wrapped(const std::string& text, std::size_t width) {
  std::string lines;
  std::size_t used = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    const std::size_t length = end - begin;
    if (used > 0) lines += used + 1 + length > width ? (used = 0, "\n") : (++used, " ");
    lines.append(text, begin, length);
    used += length;
    begin = end + 1;
  }
  return lines;
}

}  // namespace glint
