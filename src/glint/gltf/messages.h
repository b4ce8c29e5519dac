#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "glint/image/printable.h"

namespace glint::gltf {

/// Text from a file made fit for one line of a message (glint/image/printable.h).
inline std::string printable(std::string_view text, std::size_t limit = 200) {
  return glint::printable(text, limit);
}

/// `kind[index]`, with the name behind it where there is one: `meshes[2] "Wheel"`.
std::string named(std::string_view kind, std::size_t index, std::string_view name);

/// What is said about one file: errors end the loading, warnings are collected.
class Messages {
 public:
  explicit Messages(const std::filesystem::path& file);

  /// Throws InputError "FILE: what: advice".
  [[noreturn]] void fail(const std::string& what,
                         const std::string& advice = "repair the file or export it again") const;

  /// Keeps one line. A broken file can hold a million of the same fault: from the hundredth on,
  /// warnings are only counted.
  void warn(const std::string& what);

  /// The warnings, the last of them telling how many were left out.
  std::vector<std::string> take();

 private:
  std::string file_;
  std::vector<std::string> warnings_;
  std::size_t leftOut_ = 0;
};

}  // namespace glint::gltf
