#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace glint {

/// A running 64-bit hash over pieces of text or bytes, only meant to detect changed inputs: it is
/// not secure against deliberate collisions. The same on every machine.
class Hash {
 public:
  /// Adds a piece. Its length is included, so that "ab","c" and "a","bc" differ.
  void add(std::string_view bytes);
  /// 16 hexadecimal digits.
  std::string text() const;

 private:
  std::uint64_t state_ = 0xcbf29ce484222325u;
};

/// The hash of a model file and of the buffers and images that it refers to by name; of each, the
/// part that loading can need. Files that are missing, unreadable or not a model count as empty:
/// loading will report them.
std::string modelHash(const std::string& path);

/// The hash of any other file, read whole; empty if readFile() refuses it.
std::string fileHash(const std::string& path);

}  // namespace glint
