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

/// From now on, for the whole process, models read nothing that lies outside of their own folder,
/// whatever names or links lead there; the model itself may not be such a link either. For models
/// that strangers have sent.
void confineModels();
/// The folder that a model's files must lie in: its own after confineModels(), else none (empty).
/// A model from stdin, "/proc/self/fd/N", has no folder: no file lies in that.
std::filesystem::path confinementOf(const std::filesystem::path& model);
/// The folder that the model's own file must lie in: the same, but none for one from stdin.
std::filesystem::path confinementOfItself(const std::filesystem::path& model);
/// Why a file is not opened then.
inline constexpr const char* liesOutside = "lies outside of the model's folder (--confine)";

/// A file open for reading. Opens regular files only and never waits: a FIFO, a device or a folder
/// that a model names must not hang or flood the viewer.
class RegularFile {
 public:
  /// Where `error` is filled, the file is not open and `error` says why: "does not exist". A file
  /// that is not in `folder` or below it, unless that is empty, is refused.
  RegularFile(const std::filesystem::path& path, const std::filesystem::path& folder,
              std::string& error);
  ~RegularFile();
  RegularFile(const RegularFile&) = delete;
  RegularFile& operator=(const RegularFile&) = delete;

  std::uint64_t size() const { return size_; }
  /// Reads exactly `count` bytes from `offset`; false where there are fewer.
  bool read(void* to, std::uint64_t offset, std::size_t count) const;

 private:
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

/// Bytes that can be read in pieces: a part of a file, opened anew for each read so that a model of
/// a thousand files does not hold them all open, or a block of memory.
class ByteSource {
 public:
  ByteSource() = default;
  explicit ByteSource(std::vector<unsigned char> bytes);
  /// Of a file that may only lie in `folder`, as RegularFile.
  ByteSource(std::filesystem::path path, std::filesystem::path folder, std::uint64_t start,
             std::uint64_t size);

  std::uint64_t size() const { return size_; }
  /// Reads exactly `count` bytes from `offset`; false where there are fewer.
  bool read(void* to, std::uint64_t offset, std::size_t count) const;

 private:
  std::filesystem::path path_;  ///< empty for memory
  std::filesystem::path folder_;
  std::uint64_t start_ = 0;
  std::uint64_t size_ = 0;
  std::vector<unsigned char> bytes_;
};

/// A model file taken apart: its JSON text and, in a GLB file, where the binary chunk lies.
struct Container {
  std::string json;
  std::optional<ByteSource> binary;
};

/// Reads a `.gltf` or `.glb` file, told apart by the first four bytes. Checks the GLB header, the
/// chunks' lengths and types; tolerates chunks not aligned to four bytes, chunks of unknown type
/// and bytes behind the end that the header tells.
Container readContainer(const std::filesystem::path& path, const Messages& messages);

/// What a URI stands for: the payload of a `data:` URI or the file named relative to the folder of
/// `model`, percent-decoded. Where there is none, `error` says why, without the URI.
ByteSource openUri(const std::string& uri, const std::filesystem::path& model, std::string& error);

/// Is it a `data:` URI? The scheme counts in any case of its letters.
bool isDataUri(std::string_view uri);

/// What other readers may refuse in a URI that openUri() takes, to stand in a warning, or nothing.
std::string oddityOf(const std::string& uri);

/// A URI with its %XX resolved.
std::string percentDecoded(std::string_view text);

/// The URI as it may stand in a message: data URIs are cut behind their media type.
std::string printableUri(std::string_view uri);

}  // namespace glint::gltf
