#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace glint::gltf {

/// A range in a text: from `begin` up to `end`.
struct TextSpan {
  std::size_t begin = 0, end = 0;
};

/// A valid JSON text (accepted by glint/image/json_text.h) that is edited by replacing values and
/// inserting members, so that everything else is preserved byte for byte. Every call takes time
/// linear in the text; make many edits of a long text with a single replace().
class JsonText {
 public:
  using Path = std::vector<std::string>;

  /// The text holds an object; anything before it (a byte order mark) is preserved.
  explicit JsonText(std::string text) : text_(std::move(text)) {}
  const std::string& text() const { return text_; }
  std::string text(TextSpan at) const { return text_.substr(at.begin, at.end - at.begin); }

  /// The value at a path of keys; empty if there is none.
  std::optional<TextSpan> find(const Path& path) const;
  std::optional<nlohmann::json> value(const Path& path) const;
  /// A member of the object at `object`; for duplicate keys the last, as in parsers.
  std::optional<TextSpan> member(TextSpan object, const std::string& key) const;
  /// The entries of the array at `array`; none if it is not an array.
  std::vector<TextSpan> items(TextSpan array) const;

  /// Sets a member, creating missing objects on the way. A value of another type where an object is
  /// needed is replaced.
  void set(const Path& path, const std::string& value);
  /// Appends to an array, which must exist.
  void push(const Path& array, const std::string& value);
  /// Replaces spans, which must be in order and not overlap, by other texts.
  void replace(const std::vector<std::pair<TextSpan, std::string>>& others);

 private:
  void append(TextSpan container, const std::string& entry);
  std::size_t skipSpace(std::size_t i) const;
  std::size_t skipString(std::size_t i) const;
  std::size_t skipValue(std::size_t i) const;

  std::string text_;
};

}  // namespace glint::gltf
