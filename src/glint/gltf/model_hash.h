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
/// much as loading it can need. What is missing, unreadable or no model counts as empty: loading it
/// will say so.
std::string modelHash(const std::string& path);

/// The hash of any other file that is read whole; empty where readFile() refuses it.
std::string fileHash(const std::string& path);

}  // namespace glint
