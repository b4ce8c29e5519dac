#pragma once

#include <mutex>
#include <optional>

#include "glint/glint.h"
#include "glint/gltf/scene_file.h"
#include "glint/render/decode.h"
#include "glint/scene/camera.h"

namespace glint {

/// A file in memory, accessible through a path in /proc, so that models are read from it as usual.
class MemoryFile {
 public:
  /// Throws Error.
  explicit MemoryFile(std::span<const std::byte> bytes);
  ~MemoryFile();
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  const std::string& path() const { return path_; }

 private:
  int descriptor_;
  std::string path_;
};

struct Model::State {
  /// Throws InputError. `name` is how messages refer to a file in memory.
  explicit State(const std::filesystem::path& path);
  State(std::span<const std::byte> bytes, std::string name);

  /// Poses the scene for a look. `mutex` must be held, as for everything below.
  void pose(const Look& look);
  /// Calls read(); InputErrors refer to a file in memory by its name.
  template <typename Read>
  auto named(Read read) const;

  mutable std::mutex mutex;
  std::string name;
  std::optional<MemoryFile> memory;
  std::optional<SceneFile> file;
  Scene scene;
  Bounds bounds, restBounds;
  /// How often the scene has been posed, and the meshes whose vertices the last pose changed.
  int posed = 0;
  std::vector<int> changed;
  std::optional<PoseRequest> request;  ///< the current pose; empty if posing failed
  DecodedImages images;                ///< for the reference
};

template <typename Read>
auto Model::State::named(Read read) const {
  if (!memory) return read();
  try {
    return read();
  } catch (const InputError& error) {
    std::string text = error.what();
    for (auto at = text.find(memory->path()); at != std::string::npos;
         at = text.find(memory->path(), at + name.size()))
      text.replace(at, memory->path().size(), name);
    throw InputError(text);
  }
}

/// Builds a binary glTF file from the arrays. Throws InputError for inconsistent arrays.
std::vector<std::byte> glbOf(std::span<const Arrays> parts);

}  // namespace glint
