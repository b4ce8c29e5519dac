#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace glint::gltf {

/// A place in a text: from `begin` up to `end`.
struct TextSpan {
  std::size_t begin = 0, end = 0;
};

/// A valid JSON text (glint/image/json_text.h has read it) that is edited by replacing values and
/// inserting members, so that all else stays byte for byte. Every call but value() takes time
/// linear in the text: many edits of a long text go through replace(), together.
class JsonText {
 public:
  using Path = std::vector<std::string>;

  /// The text holds an object; what stands before it (a byte order mark) stays.
  explicit JsonText(std::string text) : text_(std::move(text)) {}
  const std::string& text() const { return text_; }
  std::string text(TextSpan at) const { return text_.substr(at.begin, at.end - at.begin); }

  /// The value at a path of keys; empty where there is none.
  std::optional<TextSpan> find(const Path& path) const;
  std::optional<nlohmann::json> value(const Path& path) const;
  /// A member of the object at `object`; of several of one name the last, which parsers take.
  std::optional<TextSpan> member(TextSpan object, const std::string& key) const;
  /// The entries of the array at `array`; none if it is none.
  std::vector<TextSpan> items(TextSpan array) const;

  /// Sets a member of objects that are made where they are missing. A value of another type where
  /// an object is needed is replaced.
  void set(const Path& path, const std::string& value);
  /// Adds to an array, which must exist.
  void push(const Path& array, const std::string& value);
  /// Puts other texts in place of spans, which do not overlap and are in order.
  void replace(const std::vector<std::pair<TextSpan, std::string>>& others);

 private:
  void append(TextSpan container, const std::string& entry);
  std::size_t skipSpace(std::size_t i) const;
  std::size_t skipString(std::size_t i) const;
  std::size_t skipValue(std::size_t i) const;

  std::string text_;
};

}  // namespace glint::gltf
