#include "glint/image/json_text.h"

#include "glint/image/printable.h"

namespace glint {
namespace {

/// What a text's brackets alone reveal.
struct Brackets {
  bool tooDeep = false;
  std::size_t count = 0;  ///< arrays and objects
};

Brackets bracketsOf(std::string_view text) {
  Brackets all;
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
      ++all.count;
      if (++depth > maxJsonNesting) {
        all.tooDeep = true;
        return all;
      }
    } else if (c == '}' || c == ']') {
      --depth;
    }
  }
  return all;
}

}  // namespace

std::string jsonRefusal(std::string_view text) {
  const Brackets brackets = bracketsOf(text);
  if (brackets.tooDeep) return "JSON nested more than " + std::to_string(maxJsonNesting) + " deep";
  if (brackets.count > jsonBracketsFree && brackets.count * jsonBytesForBrackets > text.size())
    return "JSON of " + std::to_string(brackets.count) +
           " arrays and objects, most of them empty, in " + std::to_string(text.size()) + " bytes";
  return {};
}

std::string jsonErrorText(const std::exception& error) {
  // "[json.exception.parse_error.101] parse error at line 3, column 7: ..."
  std::string_view what = error.what();
  if (const auto end = what.find("] "); end != what.npos) what.remove_prefix(end + 2);
  return printable(what, 200);
}

}  // namespace glint
