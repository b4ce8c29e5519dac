#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "glint/scene/look.h"
#include "glint/scene/scene.h"

namespace glint {

/// Which pose of a model is wanted: without a time the one the file stands in; with one, that of an
/// animation, held at its first and its last key before and after them.
struct PoseRequest {
  std::optional<double> time;  ///< seconds
  std::string animation = {};  ///< name, number or "all"; empty: the first
  std::string scene = {};      ///< name or number; empty: the file's own
  std::string variant = {};    ///< name (KHR_materials_variants); empty: the default
  UpAxis up = UpAxis::plusY;   ///< of the file: it is turned so that this points along +Y
  bool operator==(const PoseRequest&) const = default;
};

PoseRequest poseOf(const Look&);

/// A glTF 2.0 model that stays open, to be posed again and again: file, materials and textures are
/// read once, and posing makes anew only what moves.
class SceneFile {
 public:
  /// Takes `.gltf` or `.glb` (told apart by content, not by name), with all it refers to: buffers
  /// and the images that its textures show, not decoded.
  ///
  /// Reads every accessor layout, primitive mode and texture setting, cameras, lights, animations,
  /// morph targets and skins (both baked into meshes of their own), and the extensions that
  /// docs/materials.md lists.
  ///
  /// Throws InputError, one line "PATH: what is wrong: what to do", for a file that cannot be read,
  /// is not glTF 2.0, contradicts itself or requires an extension not supported.
  explicit SceneFile(const std::filesystem::path& path);
  ~SceneFile();
  SceneFile(SceneFile&&) noexcept;
  SceneFile& operator=(SceneFile&&) noexcept;

  /// The scene; to be called once.
  ///
  /// It satisfies what scene.h promises: indices in range, values finite, normals of unit length.
  /// What is wrong but harmless is mended and told in Scene::warnings. Throws InputError for an
  /// animation, a scene or a variant that the file does not have.
  Scene take(const PoseRequest& request = {});

  /// Brings the scene, as take() gave it, into another pose. Returns the meshes (indices into
  /// Scene::meshes) whose vertices are new; the others stay as they are.
  std::vector<int> pose(Scene& scene, const PoseRequest& request);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Reads a model that is wanted in one pose.
Scene loadGltf(const std::filesystem::path& path, const PoseRequest& request = {});

}  // namespace glint
