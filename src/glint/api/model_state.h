#pragma once

#include <mutex>
#include <optional>

#include "glint/glint.h"
#include "glint/gltf/scene_file.h"
#include "glint/render/decode.h"
#include "glint/scene/camera.h"

namespace glint {

/// A file in memory under a name of /proc, from which models are read as from any other.
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
  /// Throws InputError. What a file in memory is called in messages is `name`.
  explicit State(const std::filesystem::path& path);
  State(std::span<const std::byte> bytes, std::string name);

  /// Brings the scene into the pose of a look. To be called under `mutex`, as all below.
  void pose(const Look& look);
  /// read(), whose InputErrors call a file in memory by its name.
  template <typename Read>
  auto named(Read read) const;

  mutable std::mutex mutex;
  std::string name;
  std::optional<MemoryFile> memory;
  std::optional<SceneFile> file;
  Scene scene;
  Bounds bounds, restBounds;
  /// How often the scene has been posed; the meshes whose vertices the last time has changed.
  int posed = 0;
  std::vector<int> changed;
  std::optional<PoseRequest> request;  ///< the pose that it has; none where posing failed
  DecodedImages images;                ///< of the reference
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

/// A binary glTF file of the arrays. Throws InputError for arrays that do not fit each other.
std::vector<std::byte> glbOf(std::span<const Arrays> parts);

}  // namespace glint
