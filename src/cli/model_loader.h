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

/// A model with its pictures to be, read and decoded, or why it could not be.
struct LoadedModel {
  ModelEntry entry;
  std::vector<PlannedPicture> pictures;
  std::vector<bool> present;  ///< of each picture: it is there already
  Look look;                  ///< the run's, with what the list says of this model
  std::string hash;
  Scene scene;
  Bounds bounds;
  DecodedImages images;
  std::optional<SceneFile> file;  ///< of a sequence over an animation, to be posed
  double duration = 0;            ///< of the animation, seconds
  Bounds allBounds;               ///< around all its poses; else `bounds`
  std::string error;              ///< empty if all is well
  double loadTime = 0, decodeTime = 0;
};

/// Reads the models of a list ahead of those who draw them: at most `jobs` are being read or wait
/// to be taken, however long the list. Their order is the list's.
class ModelLoader {
 public:
  /// The look, the options and the plan must outlive it.
  ModelLoader(ModelList& list, PicturePlan& plan, const RenderOptions& options, const Look& look);
  /// Waits for the models that are being read.
  ~ModelLoader();
  ModelLoader(const ModelLoader&) = delete;
  ModelLoader& operator=(const ModelLoader&) = delete;

  /// Waits until the first one has been read, or there is none.
  void waitForFirst();
  /// The next one; empty at the end, and after a signal. Throws InputError if the list cannot be
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
  std::thread reader_;  ///< none where the system gives none: next() then reads
};

}  // namespace glint
