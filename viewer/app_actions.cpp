#include <algorithm>
#include <cmath>

#include "app.h"
#include "camera_control.h"
#include "glint/image/error.h"
#include "glint/image/file.h"
#include "glint/scene/parameters.h"
#include "materials.h"

namespace glint {

namespace fs = std::filesystem;

namespace {

FileState stateOfFolder(const fs::path& folder) {
  FileState all;
  std::error_code error;
  for (const auto& each : fs::directory_iterator(folder, error)) {
    const FileState state = stateOf(each.path());
    all.time = std::max(all.time, state.time);
    all.size += state.size;
  }
  return all;
}

}  // namespace

void App::attempt(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    session_.fail(error.what());
  }
}

void App::load(const fs::path& path) {
  if (loading_.valid()) loading_.wait();
  loadingPath_ = path;
  modelState_ = stateOf(path);
  Look look = session_.document.a;
  loading_ = std::async(std::launch::async, [path, look]() mutable {
    struct Wake {
      ~Wake() { Window::wake(); }
    } wake;
    return loadModel(path, look);
  });
}

void App::finishLoading() {
  attempt([&] {
    std::shared_ptr<Model> model = loading_.get();
    // The old model's objects in the driver refer to its scene.
    a_.reset();
    b_.reset();
    gpuScene_.reset();
    session_.take(std::move(model));
    gpuScene_ =
        std::make_unique<GpuScene>(session_.model->scene, std::move(session_.model->images));
    failed_.reset();
    probe_.reset();
    screenStale_ = overlayStale_ = probeStale_ = true;
    const std::size_t warnings = session_.model->scene.warnings.size();
    session_.say("read " + session_.model->path.string() +
                 (warnings ? " (" + std::to_string(warnings) + " warnings: see Info)" : ""));
  });
  // A file that could not be read is tried again when it changes; another one is forgotten.
  if (session_.model && session_.model->path != loadingPath_)
    modelState_ = stateOf(session_.model->path);
}

void App::watch() {
  if (session_.model && !loading_.valid()) {
    const FileState now = stateOf(session_.model->path);
    // A file that is gone is being replaced; it is read when it is back.
    if (now != modelState_ && now != FileState{}) load(session_.model->path);
  }
  if (!session_.lookPath.empty()) {
    const FileState now = stateOf(session_.lookPath);
    if (now != lookState_ && now != FileState{}) {
      lookState_ = now;
      attempt([&] {
        Look look;
        readLookFile(look, session_.lookPath.string());
        session_.document.a = look;
        session_.saved = look;
        session_.say("read " + session_.lookPath.string() + " again");
      });
    }
  }
  if (!options_.glsl.empty()) {
    const FileState now = stateOfFolder(options_.glsl);
    if (glslState_ == FileState{}) glslState_ = now;
    if (now != glslState_) {
      glslState_ = now;
      attempt([&] {
        // A shader that does not compile leaves the picture as it was; the next change is tried.
        auto fresh = std::make_unique<Renderer>(GlslSources(options_.glsl));
        Look look = session_.document.a;
        look.resolution = resolution_;
        if (gpuScene_) {
          const DrawnPicture tried = drawPicture(*fresh, *gpuScene_, session_.model->bounds, look);
        }
        renderer_ = std::move(fresh);
        a_.reset();
        b_.reset();
        failed_.reset();
        session_.say("compiled the shaders of " + options_.glsl.string() + " again");
      });
    }
  }
}

void App::open(const std::string& path) {
  const fs::path file(path);
  if (file.extension() == ".json" || file.extension() == ".look") {
    attempt([&] {
      Look look;
      readLookFile(look, path);
      if (session_.model) checkMaterialNames(session_.model->scene, look);
      session_.document.a = look;
      session_.saved = look;
      session_.lookPath = file;
      lookState_ = stateOf(file);
      session_.say("read the look " + path);
    });
    return;
  }
  if (!session_.unsaved()) return openAnyway(file);
  dialogs_.ask("Not saved", "Edits are not saved. Open " + file.filename().string() + " anyway?",
               {{"Open, and lose them", [this, file] { openAnyway(file); }}, {"Cancel", {}}});
}

void App::openAnyway(const fs::path& path) { load(path); }

void App::saveLookTo(const std::string& path, bool sure) {
  if (!sure && fs::exists(path)) {
    dialogs_.ask("Replace?", path + " exists. Replace it?",
                 {{"Replace", [this, path] { saveLookTo(path, true); }}, {"Cancel", {}}});
    return;
  }
  attempt([&] {
    session_.saveLook(path, resolution_);
    lookState_ = stateOf(path);
  });
}

void App::saveModelTo(const std::string& path, bool sure) {
  if (!sure && fs::exists(path)) {
    dialogs_.ask("Replace?",
                 path + " exists. Write the materials into it? Everything else in it stays.",
                 {{"Write", [this, path] { saveModelTo(path, true); }}, {"Cancel", {}}});
    return;
  }
  attempt([&] {
    session_.saveModel(path);
    modelState_ = stateOf(session_.model->path);
  });
}

void App::savePictureTo(const std::string& path, bool sure) {
  if (!sure && fs::exists(path)) {
    dialogs_.ask("Replace?", path + " exists. Replace it?",
                 {{"Replace", [this, path] { savePictureTo(path, true); }}, {"Cancel", {}}});
    return;
  }
  attempt([&] {
    writePicture(fullPicture(), session_.model ? session_.model->path.string() : "", path);
    session_.say("saved the picture as " + path);
  });
}

DrawnPicture App::fullPicture() {
  if (!gpuScene_) throw InputError("there is no picture to save: open a model");
  Look look = session_.document.a;
  look.resolution = resolution_;
  if (a_ && !a_->preview && a_->picture.look == look) return a_->picture;
  return drawLook(look, false)->picture;
}

void App::quit() {
  if (!session_.unsaved()) {
    quitting_ = true;
    return;
  }
  std::vector<Dialogs::Answer> answers;
  answers.push_back(
      {"Save the look", [this] {
         const auto saveAndQuit = [this](const std::string& path) {
           saveLookTo(path, true);
           if (!session_.unsaved()) quitting_ = true;
         };
         if (!session_.lookPath.empty()) return saveAndQuit(session_.lookPath);
         const std::string stem = session_.model ? session_.model->path.stem().string() : "glint";
         dialogs_.askPath("Save the look as", nextFreeName(".", stem, ".json").filename(), false,
                          saveAndQuit);
       }});
  if (session_.model) {
    Look rest = session_.document.a;
    rest.material = session_.saved.material;
    if (withoutCamera(rest) == withoutCamera(session_.saved))
      answers.push_back({"Save into the model", [this] {
                           saveModelTo(session_.model->path.string(), true);
                           if (!session_.unsaved()) quitting_ = true;
                         }});
  }
  answers.push_back({"Discard", [this] { quitting_ = true; }});
  answers.push_back({"Cancel", {}});
  dialogs_.ask("Not saved", "The look has edits that are not saved.", std::move(answers));
}

void App::setCompare(CompareMode mode) {
  Document& d = session_.document;
  if (!d.b) {
    session_.say("keep a look as B first (B)");
    return;
  }
  d.compare = d.compare == mode ? CompareMode::off : mode;
}

void App::hover(glm::dvec2 pixel) {
  session_.hovered.reset();
  probe_.reset();
  if (!a_ || a_->preview || !session_.model) return;
  attempt([&] {
    const glm::ivec2 at =
        glm::clamp(glm::ivec2(glm::floor(pixel)), glm::ivec2(0), a_->picture.look.resolution - 1);
    probe_ = probePixel(session_.model->scene, session_.model->bounds, *session_.model->picker,
                        a_->picture.look, a_->picture.linear, at);
    if (probe_->hit) session_.hovered = probe_->hit->material;
  });
}

void App::pick(glm::dvec2 pixel) {
  if (!session_.model) return;
  attempt([&] {
    Look look = session_.document.a;
    look.resolution = resolution_;
    const Camera camera = cameraFor(session_.model->scene, session_.model->bounds, look);
    const auto hit = session_.model->picker->pick(
        session_.model->scene, rayThrough(camera, pixel, resolution_), look.twoSided);
    session_.material = hit ? hit->material : -1;
    session_.say("selected " + materialLabel(session_.model->scene, session_.material));
  });
}

void App::execute(Action command) {
  Document& d = session_.document;
  const auto key = [&] {
    return session_.model ? materialKey(session_.model->scene, session_.material) : std::string();
  };
  const std::string stem = session_.model ? session_.model->path.stem().string() : "glint";
  const auto overlay = [&](Overlay which) {
    session_.overlay = session_.overlay == which ? Overlay::none : which;
  };
  switch (command) {
    case Action::help:
      helpShown_ = !helpShown_;
      break;
    case Action::togglePanel:
      panelShown_ = !panelShown_;
      break;
    case Action::quit:
      quit();
      break;
    case Action::open:
      dialogs_.askPath("Open a model or a look",
                       session_.model && session_.model->path.has_parent_path()
                           ? session_.model->path.parent_path().string() + "/"
                           : "./",
                       true, [this](const std::string& path) { open(path); });
      break;
    case Action::reload:
      if (session_.model) load(session_.model->path);
      break;
    case Action::saveLook:
      if (!session_.lookPath.empty()) {
        saveLookTo(session_.lookPath.string(), true);
        break;
      }
      [[fallthrough]];
    case Action::saveLookAs:
      dialogs_.askPath("Save the look as",
                       session_.lookPath.empty()
                           ? nextFreeName(".", stem, ".json").filename().string()
                           : session_.lookPath.string(),
                       false, [this](const std::string& path) { saveLookTo(path, false); });
      break;
    case Action::saveModel:
      if (session_.model) saveModelTo(session_.model->path.string(), false);
      break;
    case Action::saveModelAs:
      if (session_.model)
        dialogs_.askPath("Save the model with its materials as", session_.model->path.string(),
                         false, [this](const std::string& path) { saveModelTo(path, false); });
      break;
    case Action::screenshot:
      savePictureTo(nextFreeName(".", stem, ".png").filename().string(), false);
      break;
    case Action::screenshotAs:
      dialogs_.askPath("Save the picture as (.png or .pfm)",
                       nextFreeName(".", stem, ".png").filename().string(), false,
                       [this](const std::string& path) { savePictureTo(path, false); });
      break;
    case Action::undo:
      if (!session_.history.undo(d)) session_.say("nothing to undo");
      break;
    case Action::redo:
      if (!session_.history.redo(d)) session_.say("nothing to redo");
      break;
    case Action::copyMaterial:
      if (session_.model) {
        window_.setClipboard(
            materialText(effectiveParameters(session_.model->scene, d.a, session_.material)));
        session_.say("copied " + materialLabel(session_.model->scene, session_.material));
      }
      break;
    case Action::pasteMaterial:
      if (session_.model)
        attempt([&] {
          pasteMaterial(d.a, key(), window_.clipboard());
          session_.say("pasted");
        });
      break;
    case Action::resetMaterial:
      resetMaterial(d.a, key());
      break;
    case Action::nextProgram:
      d.a.shading = Shading((int(d.a.shading) + 1) % 5);
      session_.say("program " + std::string(shadingName(d.a.shading)));
      break;
    case Action::front:
      setView(d.a, StandardView::front);
      break;
    case Action::back:
      setView(d.a, StandardView::back);
      break;
    case Action::right:
      setView(d.a, StandardView::right);
      break;
    case Action::left:
      setView(d.a, StandardView::left);
      break;
    case Action::top:
      setView(d.a, StandardView::top);
      break;
    case Action::bottom:
      setView(d.a, StandardView::bottom);
      break;
    case Action::isometric:
      setView(d.a, StandardView::isometric);
      break;
    case Action::orthographic:
      d.a.cameraOrthographic = !d.a.cameraOrthographic;
      break;
    case Action::fit:
      if (session_.model)
        attempt([&] {
          Look look = d.a;
          look.resolution = resolution_;
          fit(look, session_.model->scene, session_.model->bounds);
          look.resolution = d.a.resolution;
          d.a = look;
        });
      break;
    case Action::resetCamera:
      resetCamera(d.a);
      break;
    case Action::nextCamera:
      if (session_.model && !session_.model->scene.cameras.empty()) {
        const int count = int(session_.model->scene.cameras.size());
        const int next = d.a.cameraIndex ? *d.a.cameraIndex + 1 : 0;
        resetCamera(d.a);
        if (next < count) d.a.cameraIndex = next;
      } else {
        session_.say("the file has no camera");
      }
      break;
    case Action::keepAsB:
      d.b = d.a;
      if (d.compare == CompareMode::off) d.compare = CompareMode::split;
      session_.say("kept the look as B");
      break;
    case Action::swapAB:
      if (d.b) std::swap(d.a, *d.b);
      break;
    case Action::compareSplit:
      setCompare(CompareMode::split);
      break;
    case Action::compareBlink:
      setCompare(CompareMode::blink);
      break;
    case Action::compareDifference:
      setCompare(CompareMode::difference);
      break;
    case Action::compareOff:
      d.compare = CompareMode::off;
      break;
    case Action::wireframe:
      overlay(Overlay::wireframe);
      break;
    case Action::normals:
      overlay(Overlay::normals);
      break;
    case Action::facing:
      overlay(Overlay::facing);
      break;
    case Action::clipped:
      overlay(Overlay::clipped);
      break;
  }
}

}  // namespace glint
