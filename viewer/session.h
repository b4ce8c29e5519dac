#pragma once

#include <cstdint>
#include <filesystem>
#include <future>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "document.h"
#include "glint/gltf/file.h"
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
  std::shared_ptr<ModelFile> file;                    ///< for posing; null if nothing in it moves
  std::shared_ptr<const gltf::RegularFile> original;  ///< as opened, even if it is deleted later
  Scene scene;                                        ///< without the bytes of its images
  Bounds bounds;
  std::shared_ptr<const DecodedImages> images;
  PoseRequest pose;                         ///< the pose of the scene
  std::vector<std::uint64_t> meshVersions;  ///< for a posed file: see changedMeshes()
  std::optional<Picker> picker;
  double loadTime = 0;  ///< ms
};

/// Reads a model; throws InputError.
std::unique_ptr<Model> loadModel(const std::filesystem::path&, const PoseRequest& = {});

/// A file's modification time and size, to detect changes.
struct FileState {
  std::filesystem::file_time_type time{};
  std::uintmax_t size = 0;
  bool operator==(const FileState&) const = default;
};
FileState stateOf(const std::filesystem::path&);

/// The panel's plots of a material.
enum class PlotView { lobe, lobeOverAngle, lobeInSpace, fresnel, fresnelLeaving, widths };
inline constexpr int plotCount = 6;

enum class Overlay { none, wireframe, normals, facing, clipped, outline };

/// The state that the window shows and edits, without GL and widgets.
struct Session {
  std::shared_ptr<const Model> model;  ///< null until one is loaded; in the current pose
  std::shared_ptr<const MeasuredMaterial> measured;  ///< for comparison in the plots; may be null
  Document document;
  std::optional<Look> tried;  ///< shown instead of A while the pointer rests on a preset
  History history;
  int material = -1;           ///< selected, an index into the scene's materials; -1 is all of them
  std::optional<int> hovered;  ///< the material under the cursor
  Overlay overlay = Overlay::none;
  std::size_t light = 0;           ///< selected, an index into the look's lights
  SwitchedOff lightsOff;           ///< among the look's lights
  bool lightHandles = false;       ///< handles are shown over the picture
  bool playing = false;            ///< the animation runs
  std::optional<int> wantedTab;    ///< tab of the panel to show next
  PlotView plot = PlotView::lobe;  ///< the last one chosen with a key
  bool plotWanted = false;         ///< `plot` must be shown next
  bool plotShown = false;          ///< `plot` was visible in this frame: keys go on to the next
  std::vector<std::string> log;    ///< errors and warnings, newest last
  std::string status;              ///< the last action
  bool statusIsError = false;

  std::filesystem::path lookPath;  ///< saveLook() writes here without asking; empty: asks
  Look saved;                      ///< as opened or last saved
  Look lookOnDisk;                 ///< the content of lookPath when it was last read or written
  /// Materials as written to the model's file since it was opened, by their indices in it. The
  /// model here keeps those it was opened with, on which the edits of the history are based.
  std::map<std::size_t, Material> written;

  void say(const std::string& text);
  void fail(const std::string& text);

  /// The look with which the model's file, as it is now, gives the picture of `look` here: edits
  /// that were written there and then undone have values of their own.
  Look lookForFile(Look look) const;

  /// Whether closing would lose something.
  bool unsaved() const;

  /// Writes the look's edits of the scene's materials to a copy of the model's file at `path`,
  /// which may be the model's own. On an error throws InputError and writes nothing.
  void saveModel(const std::filesystem::path& path);
  /// Throws InputError. `resolution` is that of the window's picture.
  void saveLook(const std::filesystem::path& path, glm::ivec2 resolution);

  /// Rereads lookPath after it changed. Its new content applies, except where the look was edited
  /// here: those edits stay, still unsaved. Throws InputError and changes nothing.
  void reloadLook();

  /// Replaces the model with a newly loaded one. Edits and camera stay if it is the same file;
  /// otherwise edits of materials that it does not have are dropped.
  void take(std::shared_ptr<const Model> loaded);
  /// Replaces the model with the same model in another pose.
  void takePose(std::shared_ptr<const Model> posed);
};

/// The first name STEM_N.EXT in the folder that does not exist yet.
std::filesystem::path nextFreeName(const std::filesystem::path& folder, const std::string& stem,
                                   const std::string& ending);

}  // namespace glint::viewer
