#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <future>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "glint/gltf/scene_file.h"
#include "glint/render/gpu_scene.h"
#include "glint/scene/camera.h"
#include "picture_plan.h"

namespace glint {

/// A model, read and decoded, with its planned pictures, or the reason why it could not be read.
struct LoadedModel {
  ModelEntry entry;
  std::vector<PlannedPicture> pictures;
  std::vector<bool> present;  ///< for each picture, whether it already exists
  Look look;                  ///< the run's, with the list's changes for this model
  std::string hash;
  Scene scene;
  Bounds bounds;
  DecodedImages images;
  std::optional<SceneFile> file;  ///< for a sequence over an animation, to be posed
  double duration = 0;            ///< of the animation, seconds
  Bounds allBounds;               ///< around all its poses; otherwise `bounds`
  std::string error;              ///< empty if all is well
  double loadTime = 0, decodeTime = 0;
};

/// Reads the models of a list ahead of drawing: at most `jobs` are being read or are waiting to be
/// taken, however long the list is. Their order is that of the list.
class ModelLoader {
 public:
  /// The look, the options and the plan must outlive it.
  ModelLoader(ModelList& list, PicturePlan& plan, const RenderOptions& options, const Look& look);
  /// Waits for the models that are being read.
  ~ModelLoader();
  ModelLoader(const ModelLoader&) = delete;
  ModelLoader& operator=(const ModelLoader&) = delete;

  /// Waits until the first model has been read, or there is none.
  void waitForFirst();
  /// The next model; empty at the end and after a signal. Throws InputError if the list cannot be
  /// read any further.
  std::optional<LoadedModel> next();

 private:
  void readList();
  bool readModel();
  void lookThroughFrames(LoadedModel& model) const;
  void readOwnLook(LoadedModel& model) const;
  LoadedModel load(const ModelEntry& entry, std::vector<PlannedPicture> pictures,
                   std::string error) const;

  ModelList& list_;
  PicturePlan& plan_;
  const RenderOptions& options_;
  const Look& look_;
  const std::size_t limit_;

  std::mutex mutex_;  ///< guards what follows
  std::condition_variable changed_;
  std::deque<std::future<LoadedModel>> models_;
  bool ended_ = false, abandoned_ = false, isThreaded_ = false;
  std::exception_ptr failure_;
  std::thread reader_;  ///< none if it could not be started: next() then reads
};

}  // namespace glint
