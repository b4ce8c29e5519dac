#include "glint/gltf/json_edit.h"

#include <cstring>

#include "glint/image/json_text.h"

namespace glint::gltf {
namespace {

bool isOneOf(const char* letters, char c) { return c != '\0' && std::strchr(letters, c); }

}  // namespace

std::optional<TextSpan> JsonText::find(const Path& path) const {
  TextSpan at{text_.find('{'), 0};
  at.end = skipValue(at.begin);
  for (const std::string& key : path) {
    const auto next = member(at, key);
    if (!next) return {};
    at = *next;
  }
  return at;
}

std::optional<nlohmann::json> JsonText::value(const Path& path) const {
  const auto at = find(path);
  if (!at) return {};
  return parsedJson<nlohmann::json>(std::string_view(text_).substr(at->begin, at->end - at->begin));
}

void JsonText::set(const Path& path, const std::string& value) {
  if (const auto at = find(path)) {
    text_.replace(at->begin, at->end - at->begin, value);
    return;
  }
  const Path parent(path.begin(), path.end() - 1);
  const std::string entry = nlohmann::json(path.back()).dump() + ": " + value;
  const auto at = find(parent);
  if (!at || text_[at->begin] != '{')
    set(parent, "{" + entry + "}");
  else
    append(*at, entry);
}

void JsonText::push(const Path& array, const std::string& value) { append(*find(array), value); }

void JsonText::replace(const std::vector<std::pair<TextSpan, std::string>>& others) {
  std::string edited;
  std::size_t at = 0;
  for (const auto& [span, other] : others) {
    edited.append(text_, at, span.begin - at);
    edited += other;
    at = span.end;
  }
  edited.append(text_, at);
  text_ = std::move(edited);
}

void JsonText::append(TextSpan container, const std::string& entry) {
  std::size_t last = container.end - 1;  // its closing bracket
  while (isOneOf(" \t\r\n", text_[last - 1])) --last;
  const bool empty = last == container.begin + 1;
  text_.insert(last, (empty ? "" : ", ") + entry);
}

std::size_t JsonText::skipSpace(std::size_t i) const {
  while (i < text_.size() && isOneOf(" \t\r\n", text_[i])) ++i;
  return i;
}

std::size_t JsonText::skipString(std::size_t i) const {
  for (++i; text_[i] != '"'; ++i)
    if (text_[i] == '\\') ++i;
  return i + 1;
}

std::size_t JsonText::skipValue(std::size_t i) const {
  std::size_t depth = 0;
  do {
    const char c = text_[i];
    if (c == '"') {
      i = skipString(i);
      continue;
    }
    if (c == '{' || c == '[') ++depth;
    if (c == '}' || c == ']') --depth;
    ++i;
    if (depth == 0 && !isOneOf("}]", c))  // a number or a literal
      while (i < text_.size() && !isOneOf(",}] \t\r\n", text_[i])) ++i;
  } while (depth > 0);
  return i;
}

std::optional<TextSpan> JsonText::member(TextSpan object, const std::string& key) const {
  if (text_[object.begin] != '{') return {};
  std::optional<TextSpan> found;
  std::size_t i = skipSpace(object.begin + 1);
  while (text_[i] != '}') {
    const std::size_t keyEnd = skipString(i);
    const std::string_view quoted = std::string_view(text_).substr(i, keyEnd - i);
    const bool same = quoted.find('\\') == quoted.npos ? quoted.substr(1, quoted.size() - 2) == key
                                                       : parsedJson<nlohmann::json>(quoted) == key;
    const std::size_t begin = skipSpace(skipSpace(keyEnd) + 1);
    const std::size_t end = skipValue(begin);
    if (same) found = TextSpan{begin, end};
    i = skipSpace(end);
    if (text_[i] == ',') i = skipSpace(i + 1);
  }
  return found;
}

std::vector<TextSpan> JsonText::items(TextSpan array) const {
  std::vector<TextSpan> spans;
  if (text_[array.begin] != '[') return spans;
  std::size_t i = skipSpace(array.begin + 1);
  while (text_[i] != ']') {
    const std::size_t end = skipValue(i);
    spans.push_back({i, end});
    i = skipSpace(end);
    if (text_[i] == ',') i = skipSpace(i + 1);
  }
  return spans;
}

}  // namespace glint::gltf
