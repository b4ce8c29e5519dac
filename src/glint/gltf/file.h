#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "glint/gltf/messages.h"

namespace glint::gltf {

/// From now on, for the whole process, models read nothing outside their own folder, whatever names
/// or links lead there; the model itself must not be such a link either. For models from untrusted
/// sources.
void confineModels();
/// The folder that must contain a model's files: its own after confineModels(), otherwise empty (no
/// restriction). A model from stdin, "/proc/self/fd/N", is confined to a folder that contains no
/// files.
std::filesystem::path confinementOf(const std::filesystem::path& model);
/// The folder that must contain the model file itself: the same, but empty for a model from stdin.
std::filesystem::path confinementOfItself(const std::filesystem::path& model);
/// The error for a file outside that folder.
inline constexpr const char* liesOutside = "is outside the model's folder (--confine)";

/// A file open for reading. Opens only regular files and never blocks: a FIFO, a device or a folder
/// that a model names must not hang or flood the viewer.
class RegularFile {
 public:
  /// If `error` is set, the file is not open and `error` gives the reason: "does not exist". Unless
  /// `folder` is empty, a file outside it and its subfolders is refused.
  RegularFile(const std::filesystem::path& path, const std::filesystem::path& folder,
              std::string& error);
  ~RegularFile();
  RegularFile(const RegularFile&) = delete;
  RegularFile& operator=(const RegularFile&) = delete;

  std::uint64_t size() const { return size_; }
  /// Reads exactly `count` bytes from `offset`; false if there are fewer.
  bool read(void* to, std::uint64_t offset, std::size_t count) const;

 private:
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

/// Bytes that can be read in pieces: a block of memory, or a part of a file, which is reopened for
/// each read so that a model with a thousand files does not keep them all open.
class ByteSource {
 public:
  ByteSource() = default;
  explicit ByteSource(std::vector<unsigned char> bytes);
  /// From a file, which must be in `folder` as for RegularFile.
  ByteSource(std::filesystem::path path, std::filesystem::path folder, std::uint64_t start,
             std::uint64_t size);

  std::uint64_t size() const { return size_; }
  /// Reads exactly `count` bytes from `offset`; false if there are fewer.
  bool read(void* to, std::uint64_t offset, std::size_t count) const;

 private:
  std::filesystem::path path_;  ///< empty for memory
  std::filesystem::path folder_;
  std::uint64_t start_ = 0;
  std::uint64_t size_ = 0;
  std::vector<unsigned char> bytes_;
};

/// A model file split up: its JSON text and, for a GLB file, the location of the binary chunk.
struct Container {
  std::string json;
  std::optional<ByteSource> binary;
};

/// Reads a `.gltf` or `.glb` file, distinguished by its first four bytes. Checks the GLB header and
/// the chunks' lengths and types; tolerates chunks not aligned to four bytes, chunks of unknown
/// type and bytes beyond the length in the header.
Container readContainer(const std::filesystem::path& path, const Messages& messages);

/// The contents of a URI: the payload of a `data:` URI, or the file named relative to the folder of
/// `model`, percent-decoded. On failure `error` gives the reason, without the URI.
ByteSource openUri(const std::string& uri, const std::filesystem::path& model, std::string& error);

/// Whether it is a `data:` URI, with the scheme in upper or lower case.
bool isDataUri(std::string_view uri);

/// A warning about a URI that openUri() accepts but other readers may refuse, or an empty string.
std::string oddityOf(const std::string& uri);

/// The text with its %XX escapes decoded.
std::string percentDecoded(std::string_view text);

/// The URI for use in a message: data URIs are cut after their media type.
std::string printableUri(std::string_view uri);

}  // namespace glint::gltf
