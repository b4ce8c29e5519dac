#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace glint {

/// A running hash of 64 bits over pieces of text or bytes; tells changed inputs from equal ones, no
/// more: it is not proof against somebody who looks for collisions. The same on every machine.
class Hash {
 public:
  /// Adds a piece. Its length counts too, so that "ab","c" and "a","bc" differ.
  void add(std::string_view bytes);
  /// 16 hexadecimal digits.
  std::string text() const;

 private:
  std::uint64_t state_ = 0xcbf29ce484222325u;
};

/// The hash of a model file and of the buffers and images that it refers to by name, of each as
/// much as loading it can need. What is missing or unreadable counts as empty: loading the model
/// will say so. Of any other file, that of its bytes.
std::string modelHash(const std::string& path);

}  // namespace glint
