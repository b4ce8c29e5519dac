#include "glint/image/json_text.h"

#include "glint/image/printable.h"

namespace glint {
namespace {

bool nestsTooDeep(std::string_view text) {
  int depth = 0;
  bool inString = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (inString) {
      if (c == '\\') ++i;
      if (c == '"') inString = false;
    } else if (c == '"') {
      inString = true;
    } else if (c == '{' || c == '[') {
      if (++depth > maxJsonNesting) return true;
    } else if (c == '}' || c == ']') {
      --depth;
    }
  }
  return false;
}

}  // namespace

std::string jsonRefusal(std::string_view text) {
  if (nestsTooDeep(text))
    return "JSON nested more than " + std::to_string(maxJsonNesting) + " deep";
  return {};
}

std::string jsonErrorText(const std::exception& error) {
  // "[json.exception.parse_error.101] parse error at line 3, column 7: ..."
  std::string_view what = error.what();
  if (const auto end = what.find("] "); end != what.npos) what.remove_prefix(end + 2);
  return printable(what, 200);
}

}  // namespace glint
