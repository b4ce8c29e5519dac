#include "session.h"

#include <algorithm>

#include "glint/gltf/patch.h"
#include "glint/gltf/scene_file.h"
#include "glint/image/clock.h"
#include "glint/image/error.h"
#include "glint/image/file.h"
#include "glint/image/read_files.h"
#include "glint/options/outputs.h"
#include "glint/options/parameters.h"
#include "glint/scene/material_key.h"
#include "glint/scene/material_parameters.h"
#include "look_merge.h"
#include "materials.h"

namespace glint::viewer {

namespace {

// The bytes of the model's file; of one that is deleted, those that it had when it was opened.
std::vector<std::byte> bytesOf(const Model& model) {
  const std::string path = model.path.string();
  if (!isMissing(path)) return readFile(path, Noted::no);
  std::vector<std::byte> bytes(model.original ? model.original->size() : 0);
  if (bytes.empty() || !model.original->read(bytes.data(), 0, bytes.size()))
    throw InputError(path + ": no longer exists and cannot be read: save the look instead");
  return bytes;
}

}  // namespace

std::unique_ptr<Model> loadModel(const std::filesystem::path& path, const PoseRequest& pose) {
  const auto start = Clock::now();
  auto model = std::make_unique<Model>();
  model->path = path;
  model->pose = pose;
  std::string error;
  model->original = std::make_shared<const gltf::RegularFile>(path, "", error);
  if (!error.empty()) model->original.reset();
  SceneFile file(path);
  model->scene = file.take(pose);
  model->bounds = boundsOf(model->scene);
  Look all;  // no look needs other images, and nothing else needs the lengths of normals
  all.specularAntialiasing = SpecularAntialiasing::toksvig;
  model->images = std::make_shared<const DecodedImages>(decodeImages(model->scene, all));
  for (EncodedImage& image : model->scene.images) std::vector<std::byte>().swap(image.bytes);
  model->picker.emplace(model->scene);
  if (!model->scene.animations.empty()) {
    model->meshVersions.assign(model->scene.meshes.size(), 0);
    model->file = std::make_shared<ModelFile>(path, std::move(file), model->scene);
  }
  model->loadTime = since(start);
  return model;
}

FileState stateOf(const std::filesystem::path& path) {
  std::error_code error;
  FileState state;
  state.time = std::filesystem::last_write_time(path, error);
  if (error) return {};
  state.size = std::filesystem::file_size(path, error);
  return error ? FileState{} : state;
}

void Session::say(const std::string& text) {
  status = text;
  statusIsError = false;
}

void Session::fail(const std::string& text) {
  log.push_back(text);
  status = text;
  statusIsError = true;
}

bool Session::unsaved() const { return withoutCamera(document.a) != withoutCamera(saved); }

void Session::saveModel(const std::filesystem::path& path) {
  if (!model) throw InputError("there is no model to save");
  const auto& materials = model->scene.materials;
  std::map<std::size_t, Material> edited = written;
  for (const int index : drawnMaterials(model->scene))
    if (isEdited(materials[std::size_t(index)], document.a)) edited[std::size_t(index)];
  std::vector<MaterialPatch> patches;
  for (auto& [i, material] : edited) {
    material = withEdits(materials[i], document.a);
    patches.push_back(patchOf(i, material));
  }
  const std::string source = model->path.string();
  const std::vector<std::byte> original = bytesOf(*model);
  const auto folder = [](const std::filesystem::path& p) {
    return std::filesystem::weakly_canonical(p).parent_path();
  };
  if (folder(path) != folder(model->path) && refersToFiles(original, source))
    throw InputError(source + " refers to files next to it: save it in the same folder");
  const std::vector<std::byte> bytes = patchGltf(original, patches, source);
  // The model itself may be replaced, but not the files that it is drawn from.
  if (std::error_code none; std::filesystem::equivalent(path, source, none)) forgetReadFile(source);
  OutputFile file(path.string());
  file.write(bytes);
  file.commit();
  if (std::filesystem::weakly_canonical(path) == std::filesystem::weakly_canonical(model->path))
    written = std::move(edited);
  saved.material = document.a.material;
  say("saved the materials into " + path.string());
}

Look Session::lookForFile(Look look) const {
  for (const auto& [i, file] : written) {
    const Material now = withEdits(model->scene.materials[i], look);
    MaterialEdit edit;
    for (const MaterialParameter& p : materialParameters())
      if (now.shading.*p.value != file.shading.*p.value) edit.*p.edit = now.shading.*p.value;
    if (now.shading.color != file.shading.color) edit.color = now.shading.color;
    for (const SwitchedTexture& t : switchedTextures())
      if ((now.switchedOff & t.bit) != (file.switchedOff & t.bit))
        edit.*t.edit = (now.switchedOff & t.bit) == 0;
    if (edit != MaterialEdit{}) mergeEdit(look.material[glint::materialKey(now)], edit);
  }
  return look;
}

void Session::saveLook(const std::filesystem::path& path, glm::ivec2 resolution) {
  Look look = lookForFile(document.a);
  look.resolution = resolution;
  const std::string text = glint::saveLook(look);
  forgetReadFile(lookPath.string());  // the edited look's own file
  writeText(path.string(), text);
  lookPath = path;
  saved = document.a;
  lookOnDisk = look;
  say("saved the look as " + path.string());
}

void Session::reloadLook() {
  Look now;
  readLookFile(now, lookPath.string());
  const bool edited = unsaved();
  document.a = mergedLook(document.a, lookOnDisk, now);
  saved = mergedLook(saved, lookOnDisk, now);
  lookOnDisk = now;
  say("read " + lookPath.string() + " again" + (edited ? "; your edits stay" : ""));
}

void Session::take(std::shared_ptr<const Model> loaded) {
  const bool same = model && model->path == loaded->path;
  const bool first = !model;
  if (same) {  // the file has what was written to it
    document.a = lookForFile(document.a);
    if (document.b) document.b = lookForFile(*document.b);
  }
  written.clear();
  model = std::move(loaded);
  playing = false;
  if (!same && !first) {  // another model is framed anew and has its own history
    document.a.cameraPosition.reset();
    document.a.cameraFocalPoint.reset();
    document.a.cameraIndex.reset();
    document.a.clippingRange.reset();
    document.a.animation.clear();
    document.a.animationTime.reset();
    document.a.material.clear();
    document.b.reset();
    document.compare = CompareMode::off;
  }
  const std::string missing = dropMissing(document.a, model->scene);
  if (!missing.empty())
    log.push_back(model->path.string() + " has no " + missing + ": the look ignores it");
  if (document.b) dropMissing(*document.b, model->scene);
  if (!same) {
    const std::vector<int> drawn = drawnMaterials(model->scene);
    material = drawn.size() == 1 ? drawn.front() : -1;
    history = History(document);
    saved = document.a;
  }
  if (material >= int(model->scene.materials.size())) material = -1;
  hovered.reset();
  for (const std::string& warning : model->scene.warnings) log.push_back(warning);
}

void Session::takePose(std::shared_ptr<const Model> posed) {
  const auto& warnings = posed->scene.warnings;
  for (std::size_t i = model->scene.warnings.size(); i < warnings.size(); ++i)
    log.push_back(warnings[i]);
  model = std::move(posed);
}

std::filesystem::path nextFreeName(const std::filesystem::path& folder, const std::string& stem,
                                   const std::string& ending) {
  for (int n = 1;; ++n) {
    const auto path = folder / (stem + "_" + std::to_string(n) + ending);
    if (!std::filesystem::exists(path)) return path;
  }
}

}  // namespace glint::viewer
