#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "glint/scene/look.h"
#include "glint/scene/scene.h"

namespace glint {

/// The requested pose of a model: without a time the file's rest pose; with one, that of an
/// animation, constant before its first and after its last key.
struct PoseRequest {
  std::optional<double> time;  ///< seconds
  std::string animation = {};  ///< name, number or "all"; empty: the first
  std::string scene = {};      ///< name or number; empty: the file's default
  std::string variant = {};    ///< name (KHR_materials_variants); empty: the default
  UpAxis up = UpAxis::plusY;   ///< the file's; the model is rotated to point it along +Y
  bool operator==(const PoseRequest&) const = default;
};

PoseRequest poseOf(const Look&);

/// The index of the animation that `--animation` names: a name before a number; the first for an
/// empty text. Throws InputError with the known ones for another.
std::size_t findAnimation(const Scene& scene, const std::string& text);

/// A glTF 2.0 model that stays open to be posed repeatedly: file, materials and textures are read
/// once, and posing rebuilds only what moves.
class SceneFile {
 public:
  /// Reads a `.gltf` or `.glb` file (distinguished by content, not by name) with everything it
  /// refers to: buffers, and the images that its textures use, not decoded.
  ///
  /// Supports every accessor layout, primitive mode and texture setting, cameras, lights,
  /// animations, morph targets and skins (both baked into meshes of their own), and the extensions
  /// listed in docs/materials.md.
  ///
  /// Throws InputError, one line "PATH: what is wrong: what to do", for a file that cannot be read,
  /// is not glTF 2.0, is inconsistent or requires an unsupported extension.
  explicit SceneFile(const std::filesystem::path& path);
  ~SceneFile();
  SceneFile(SceneFile&&) noexcept;
  SceneFile& operator=(SceneFile&&) noexcept;

  /// The scene; may be called only once.
  ///
  /// It satisfies the guarantees of scene.h: indices in range, values finite, normals of unit
  /// length. Harmless faults are corrected and reported in Scene::warnings. Throws InputError for
  /// an animation, a scene or a variant that the file does not have.
  Scene take(const PoseRequest& request = {});

  /// Changes the scene returned by take() to another pose. Returns the meshes (indices into
  /// Scene::meshes) whose vertices have changed; the others are untouched.
  std::vector<int> pose(Scene& scene, const PoseRequest& request);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Reads a model that is needed in only one pose.
Scene loadGltf(const std::filesystem::path& path, const PoseRequest& request = {});

}  // namespace glint
