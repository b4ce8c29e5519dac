#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "glint/gltf/scene_file.h"

namespace glint::viewer {

struct Model;

bool samePose(const PoseRequest&, const PoseRequest&);

/// A model's file, kept open so that its scene can be posed again without rereading it.
/// Thread-safe.
class ModelFile {
 public:
  /// `scene` is the scene taken from `file`, including later changes to its textures.
  ModelFile(std::filesystem::path path, SceneFile file, Scene scene);

  /// The model in another pose; parts that do not move are shared with `from`, a model of this
  /// file. Throws InputError, as reading does.
  std::shared_ptr<const Model> pose(const Model& from, const PoseRequest&);

 private:
  std::mutex mutex_;
  std::filesystem::path path_;
  std::optional<SceneFile> file_;
  Scene scene_;
  std::vector<std::uint64_t> versions_;  ///< by mesh: the posing that produced it
  std::uint64_t posings_ = 0;
};

/// The model in the pose; the same object if it is already in that pose or cannot move.
std::shared_ptr<const Model> posed(const std::shared_ptr<const Model>&, const PoseRequest&);

/// Meshes whose vertices differ between two poses of a model, as indices into the second.
std::vector<int> changedMeshes(const Model& before, const Model& after);

}  // namespace glint::viewer
