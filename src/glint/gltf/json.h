#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "glint/gltf/messages.h"

namespace glint::gltf {

using Json = nlohmann::json;

/// Parses a glTF file's JSON text, whose root must be an object. Fails on invalid JSON, on numbers
/// beyond the range of double and on texts that glint/image/json_text.h refuses.
Json parseJson(std::string_view text, const Messages& messages);

/// A position in the JSON document that knows its path, so that every message can give it. The
/// value may be absent; the readers then return their fallback. A value of the wrong type or out of
/// range fails with the path, the expectation and the actual value.
class Cursor {
 public:
  Cursor(Json& root, const Messages& messages) : json_(&root), messages_(&messages) {}

  bool exists() const { return json_ != nullptr; }
  Json& json() const { return *json_; }

  /// The member of an object. `key` must outlive the cursor.
  Cursor member(const char* key) const;
  /// The same, but fails if it is absent.
  Cursor required(const char* key) const;
  /// Calls `use` with each member of an object. Keys are not looked up again: one that contains a
  /// zero byte would be mistaken for another.
  template <typename Use>
  void forEachMember(const Use& use) const {
    checkObject();
    if (!exists()) return;
    for (auto it = json_->begin(); it != json_->end(); ++it) use(step(&*it, {it.key().c_str(), 0}));
  }
  /// The entry of an array, i < size().
  Cursor item(std::size_t i) const;
  /// The number of entries of an array, 0 if it is absent.
  std::size_t size() const;
  class Iterator;
  /// The entries of an array, in a loop.
  Iterator begin() const;
  Iterator end() const;

  /// An integer from `low` to `high`; 5.0 is accepted too, and corrected in the document.
  std::int64_t integer(std::int64_t fallback, std::int64_t low, std::int64_t high) const;
  /// An index into a list of `count` entries, -1 if absent.
  int index(std::size_t count) const;
  double number(double fallback) const;
  bool boolean(bool fallback) const;
  std::string text(const std::string& fallback = {}) const;
  /// Fails unless it is absent or an array of `count` numbers (of any length if 0).
  void checkNumbers(std::size_t count) const;
  void checkObject() const;

  /// The member "name" if it is text, otherwise empty: a name is never worth failing for.
  std::string name() const;
  /// The key of a member passed by forEachMember().
  const char* key() const { return steps_[depth_ - 1].key; }
  /// The path, as in `nodes[3].children`.
  std::string path() const;
  [[noreturn]] void fail(const std::string& what) const;

 private:
  struct Step {
    const char* key = nullptr;
    std::size_t index = 0;
  };
  Cursor step(Json* json, Step step) const;
  [[noreturn]] void expected(const std::string& what) const;

  Json* json_;
  const Messages* messages_;
  std::array<Step, 10> steps_{};
  std::size_t depth_ = 0;
};

class Cursor::Iterator {
 public:
  Iterator(const Cursor& list, std::size_t at) : list_(&list), at_(at) {}
  Cursor operator*() const { return list_->item(at_); }
  void operator++() { ++at_; }
  bool operator==(const Iterator& other) const { return at_ == other.at_; }

 private:
  const Cursor* list_;
  std::size_t at_;
};

inline Cursor::Iterator Cursor::begin() const { return {*this, 0}; }
inline Cursor::Iterator Cursor::end() const { return {*this, size()}; }

}  // namespace glint::gltf
