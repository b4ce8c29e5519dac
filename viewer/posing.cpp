#include "posing.h"

#include <utility>

#include "session.h"

namespace glint::viewer {

bool samePose(const PoseRequest& a, const PoseRequest& b) { return a == b; }

ModelFile::ModelFile(std::filesystem::path path, SceneFile file, Scene scene)
    : path_(std::move(path)),
      file_(std::move(file)),
      scene_(std::move(scene)),
      versions_(scene_.meshes.size(), 0) {}

std::shared_ptr<const Model> ModelFile::pose(const Model& from, const PoseRequest& request) {
  const std::lock_guard lock(mutex_);
  if (!file_) {  // dropped by an error during posing
    file_.emplace(path_);
    Scene fresh = file_->take();
    fresh.materials = scene_.materials;
    scene_ = std::move(fresh);
    versions_.assign(scene_.meshes.size(), ++posings_);
  }
  std::vector<int> changed;
  try {
    changed = file_->pose(scene_, request);
  } catch (...) {
    file_.reset();
    throw;
  }
  versions_.resize(scene_.meshes.size(), 0);
  ++posings_;
  for (const int mesh : changed) versions_[std::size_t(mesh)] = posings_;
  auto model = std::make_shared<Model>();
  model->path = from.path;
  model->file = from.file;
  model->scene = scene_;
  model->bounds = boundsOf(model->scene);
  model->images = from.images;
  model->pose = request;
  model->meshVersions = versions_;
  model->picker = from.picker;
  model->picker->update(model->scene, changedMeshes(from, *model));
  model->loadTime = from.loadTime;
  return model;
}

std::shared_ptr<const Model> posed(const std::shared_ptr<const Model>& model,
                                   const PoseRequest& request) {
  if (samePose(model->pose, request) || !model->file) return model;
  return model->file->pose(*model, request);
}

std::vector<int> changedMeshes(const Model& before, const Model& after) {
  std::vector<int> changed;
  for (std::size_t i = 0; i < after.meshVersions.size(); ++i)
    if (i >= before.meshVersions.size() || before.meshVersions[i] != after.meshVersions[i])
      changed.push_back(int(i));
  return changed;
}

}  // namespace glint::viewer
