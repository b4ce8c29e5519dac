#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "glint/image/printable.h"

namespace glint::gltf {

/// Makes text from a file fit for one line of a message (glint/image/printable.h).
inline std::string printable(std::string_view text, std::size_t limit = 200) {
  return glint::printable(text, limit);
}

/// `kind[index]`, followed by the name if there is one: `meshes[2] "Wheel"`.
std::string named(std::string_view kind, std::size_t index, std::string_view name);

/// Messages about one file: errors end loading, warnings are collected.
class Messages {
 public:
  explicit Messages(const std::filesystem::path& file);

  /// Throws InputError "FILE: what: advice".
  [[noreturn]] void fail(const std::string& what,
                         const std::string& advice = "repair the file or export it again") const;

  /// Records one line. A broken file can contain a million of the same fault: after the first
  /// hundred, warnings are only counted.
  void warn(const std::string& what);

  /// The warnings; the last one gives the number left out.
  std::vector<std::string> take();

 private:
  std::string file_;
  std::vector<std::string> warnings_;
  std::size_t leftOut_ = 0;
};

}  // namespace glint::gltf
