#include "model_loader.h"

#include <algorithm>

#include "glint/gltf/model_hash.h"
#include "glint/image/clock.h"
#include "glint/image/error.h"
#include "glint/image/file.h"
#include "glint/image/read_image.h"
#include "glint/image/task.h"
#include "glint/options/exit_status.h"
#include "glint/options/parameters.h"
#include "glint/options/picture_text.h"
#include "glint/reference/renderer.h"
#include "glint/render/left_out.h"
#include "glint/scene/material_parameters.h"
#include "interrupt.h"
#include "stdin_model.h"

namespace glint {
namespace {

// Pictures appear whole or not at all, so one that has the key is complete.
bool isPresent(const std::string& path, const std::string& key) {
  try {
    const auto text = readPictureText(path);
    const auto found = text.find("glint-key");
    return found != text.end() && found->second == key;
  } catch (const InputError&) {
    return false;
  }
}

std::size_t jobsOf(const RenderOptions& options) {
  if (options.jobs > 0) return std::size_t(options.jobs);
  return std::clamp(std::thread::hardware_concurrency(), 1u, 8u);
}

}  // namespace

ModelLoader::ModelLoader(ModelList& list, PicturePlan& plan, const RenderOptions& options,
                         const Look& look)
    : list_(list),
      plan_(plan),
      options_(options),
      look_(look),
      limit_(jobsOf(options)),
      reader_(startThread([this] { readList(); })) {}

ModelLoader::~ModelLoader() {
  {
    const std::lock_guard lock(mutex_);
    abandoned_ = true;
    changed_.notify_all();
  }
  if (reader_.joinable()) reader_.join();
}

void ModelLoader::readList() {
  isThreaded_ = true;
  while (readModel()) continue;
}

// Starts loading the next model of the list; false at its end.
bool ModelLoader::readModel() {
  std::exception_ptr failure;
  try {
    while (const auto entry = list_.next()) {
      std::vector<PlannedPicture> pictures;
      std::string error;
      try {
        pictures = plan_.picturesOf(*entry);
        if (pictures.empty()) continue;
      } catch (const InputError& refusal) {
        pictures.resize(1);
        error = refusal.what();
      }
      std::unique_lock lock(mutex_);
      if (isThreaded_)
        changed_.wait(lock, [this] { return abandoned_ || models_.size() < limit_; });
      if (abandoned_) break;
      models_.push_back(startTask(
          [this, entry = *entry, pictures, error] { return load(entry, pictures, error); }));
      changed_.notify_all();
      return true;
    }
  } catch (...) {
    failure = std::current_exception();
  }
  const std::lock_guard lock(mutex_);
  failure_ = failure;
  ended_ = true;
  changed_.notify_all();
  return false;
}

LoadedModel ModelLoader::load(const ModelEntry& entry, std::vector<PlannedPicture> pictures,
                              std::string error) const {
  LoadedModel model;
  model.entry = entry;
  model.look = look_;
  model.pictures = std::move(pictures);
  model.present.assign(model.pictures.size(), false);
  model.error = std::move(error);
  if (!model.error.empty()) return model;
  try {
    const auto start = Clock::now();
    readOwnLook(model);
    if (options_.list == "-" && isStdin(entry.model))
      throw InputError("--from-list -: " + entry.model +
                       " in it: stdin is already used for the list: give a file");
    const std::string path = modelFile(entry.model);
    std::future<std::string> hash = startTask([path] { return modelHash(path); });
    if (options_.resume) {
      model.hash = hash.get();
      PictureOrigin origin{model.hash, {}, options_.bitDepth, {}};
      if (!options_.usesReference()) origin.gl.emplace();
      for (std::size_t i = 0; i < model.pictures.size(); ++i) {
        origin.variation = model.pictures[i].variation;
        model.present[i] = isPresent(model.pictures[i].output, pictureKey(model.look, origin));
      }
      if (std::find(model.present.begin(), model.present.end(), false) == model.present.end())
        return model;
    }
    model.file.emplace(path);
    model.scene = model.file->take(poseOf(model.look));
    if (isStdin(entry.model)) model.scene.name = "stdin";
    model.bounds = model.allBounds = boundsOf(model.scene);
    if (options_.frames > 0)
      lookThroughFrames(model);
    else
      model.file.reset();
    model.loadTime = since(start);
    checkMaterialNames(model.scene, model.look);
    const auto decode = Clock::now();
    model.images = decodeImages(model.scene, model.look);
    for (const LeftOut& each : leftOut(model.scene, model.look))
      if (each.shows) model.scene.warnings.push_back(leftOutText(each));
    model.decodeTime = since(decode);
    if (hash.valid()) model.hash = hash.get();
  } catch (const std::exception& failure) {
    model.error = failureOf(failure, entry.model);
    if (isStdin(entry.model) && options_.list != "-") model.error = withoutModelFile(model.error);
  }
  return model;
}

void ModelLoader::readOwnLook(LoadedModel& model) const {
  const ModelEntry& entry = model.entry;
  if (!entry.lookFile.empty())
    readLookOver(model.look, lookTextIn(entry.lookFile), entry.lookFile);
  else if (!entry.look.empty())
    readLookOver(model.look, entry.look, printablePath(entry.model) + ": \"look\"");
  else
    return;
  if (options_.usesReference()) checkReferenceAntiAliasing(model.look.antiAliasing);
}

// The camera does not move, so it must see every pose.
void ModelLoader::lookThroughFrames(LoadedModel& model) const {
  const auto& animations = model.scene.animations;
  const bool all = model.look.animation == "all" && !animations.empty();
  if (animations.empty())
    throw InputError("--frames: " + printablePath(model.entry.model) +
                     " has no animation: leave the option out");
  if (all)
    for (const FileAnimation& each : animations)
      model.duration = std::max(model.duration, each.duration);
  else
    model.duration = animations[findAnimation(model.scene, model.look.animation)].duration;
  for (int frame = 0; frame < options_.frames; ++frame) {
    PoseRequest pose = poseOf(model.look);
    pose.time = model.duration * frame / options_.frames;
    model.file->pose(model.scene, pose);
    const Bounds bounds = boundsOf(model.scene);
    model.allBounds = frame == 0 ? bounds : around(model.allBounds, bounds);
  }
}

void ModelLoader::waitForFirst() {
  if (!reader_.joinable()) readModel();
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return ended_ || !models_.empty(); });
  if (models_.empty()) return;
  const auto& first = models_.front();  // stays valid: only next() removes it
  lock.unlock();
  first.wait();
}

std::optional<LoadedModel> ModelLoader::next() {
  if (!reader_.joinable() && models_.empty() && !ended_) readModel();
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return ended_ || !models_.empty(); });
  if (Interrupt::signal() != 0) return {};
  if (models_.empty()) {
    if (failure_) std::rethrow_exception(failure_);
    return {};
  }
  std::future<LoadedModel> model = std::move(models_.front());
  models_.pop_front();
  changed_.notify_all();
  lock.unlock();
  return model.get();
}

}  // namespace glint
