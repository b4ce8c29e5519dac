#pragma once

#include <cstdint>
#include <filesystem>
#include <future>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "document.h"
#include "glint/gltf/scene_file.h"
#include "glint/render/gpu_scene.h"
#include "glint/scene/camera.h"
#include "glint/scene/scene.h"
#include "light_edit.h"
#include "measured.h"
#include "picking.h"
#include "posing.h"

namespace glint::viewer {

/// A model read from its file.
struct Model {
  std::filesystem::path path;
  std::shared_ptr<ModelFile> file;  ///< to be posed; null if nothing in it moves
  Scene scene;                      ///< without the bytes of its pictures
  Bounds bounds;
  std::shared_ptr<const DecodedImages> images;
  PoseRequest pose;                         ///< that the scene is in
  std::vector<std::uint64_t> meshVersions;  ///< of a file that is posed: see changedMeshes()
  std::optional<Picker> picker;
  double loadTime = 0;  ///< ms
};

/// Reads a model; throws InputError.
std::unique_ptr<Model> loadModel(const std::filesystem::path&, const PoseRequest& = {});

/// When a file was last written, and how long it is: by which a change is noticed.
struct FileState {
  std::filesystem::file_time_type time{};
  std::uintmax_t size = 0;
  bool operator==(const FileState&) const = default;
};
FileState stateOf(const std::filesystem::path&);

/// What the panel plots of a material.
enum class PlotView { lobe, lobeOverAngle, lobeInSpace, fresnel, fresnelLeaving, widths };
inline constexpr int plotCount = 6;

enum class Overlay { none, wireframe, normals, facing, clipped, outline };

/// What the window shows and edits, without GL and widgets.
struct Session {
  std::shared_ptr<const Model> model;  ///< null until one is loaded; in the pose that is shown
  std::shared_ptr<const MeasuredMaterial> measured;  ///< beside the material's plots; may be null
  Document document;
  std::optional<Look> tried;  ///< shown in place of A while the pointer rests on a preset
  History history;
  int material = -1;           ///< selected, an index into the scene's; -1 is all of them
  std::optional<int> hovered;  ///< the material under the cursor
  Overlay overlay = Overlay::none;
  std::size_t light = 0;           ///< selected, of those that the look has
  SwitchedOff lightsOff;           ///< of those that the look has
  bool lightHandles = false;       ///< are shown over the picture
  bool playing = false;            ///< the animation runs
  std::optional<int> wantedTab;    ///< of the panel, to be shown next
  PlotView plot = PlotView::lobe;  ///< that keys have chosen last
  bool plotWanted = false;         ///< it is to be shown next
  bool plotShown = false;          ///< was, in this frame: keys go on to the next
  std::vector<std::string> log;    ///< errors and warnings, the newest last
  std::string status;              ///< the last thing that was done
  bool statusIsError = false;

  std::filesystem::path lookPath;  ///< where saveLook writes without asking; empty: asks
  Look saved;                      ///< as it was opened or last saved
  Look lookOnDisk;                 ///< what lookPath held when it was last read or written
  /// Materials that stand edited in the model's file since it was opened, by their places in it.
  std::set<std::size_t> writtenMaterials;

  void say(const std::string& text);
  void fail(const std::string& text);

  /// Whether something would be lost on closing.
  bool unsaved() const;

  /// Writes what `look` says of the scene's materials into a copy of the model's file at `path`,
  /// which may be the model's own. Throws InputError and writes nothing.
  void saveModel(const std::filesystem::path& path);
  /// Throws InputError. `resolution` is that of the window's picture.
  void saveLook(const std::filesystem::path& path, glm::ivec2 resolution);

  /// Reads lookPath, which has changed, again: what it says now stands, but for what has been
  /// edited here, which stays and stays unsaved. Throws InputError and changes nothing.
  void reloadLook();

  /// Puts a newly loaded model in place of the old one. Edits and camera stay if it is the same
  /// file; otherwise edits of materials that it does not have go.
  void take(std::shared_ptr<const Model> loaded);
  /// Puts the same model in another pose in its place.
  void takePose(std::shared_ptr<const Model> posed);
};

/// The first name STEM_N.ENDING in the folder that does not exist yet.
std::filesystem::path nextFreeName(const std::filesystem::path& folder, const std::string& stem,
                                   const std::string& ending);

}  // namespace glint::viewer
