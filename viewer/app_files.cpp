#include <algorithm>
#include <cctype>
#include <ctime>

#include "app.h"
#include "effects.h"
#include "glint/image/error.h"
#include "glint/image/file.h"
#include "glint/image/picture_writer.h"
#include "glint/image/read_files.h"
#include "glint/options/parameters.h"
#include "materials.h"
#include "own_presets.h"

namespace glint::viewer {

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

void App::load(const fs::path& path) {
  if (loading_.valid()) {  // loading cannot be cancelled; the window goes on meanwhile
    nextPath_ = path;
    return;
  }
  loadingPath_ = path;
  modelState_ = stateOf(path);
  const bool another = session_.model && session_.model->path != path;
  const PoseRequest pose = another ? PoseRequest{} : poseOf(session_.document.a);
  loading_ = std::async(std::launch::async, [path, pose] {
    struct Wake {
      ~Wake() { Window::wake(); }
    } wake;
    return loadModel(path, pose);
  });
}

void App::finishLoading() {
  attempt([&] {
    const std::size_t before = session_.log.size();
    session_.take(loading_.get());
    painter_->setModel(session_.model);
    reference_->stop();
    shownResult_ = {};
    requested_.reset();
    failed_.reset();
    probe_.reset();
    pivot_.reset();
    screenStale_ = probeStale_ = true;
    const std::size_t warnings = session_.log.size() - before;
    session_.say("opened " + session_.model->path.string() +
                 (warnings ? " (" + std::to_string(warnings) + " warnings: see Info)" : ""));
  });
  // A model that could not be reloaded is retried when its file changes; another file that could
  // not be read is forgotten.
  if (session_.model && session_.model->path != loadingPath_)
    modelState_ = stateOf(session_.model->path);
  if (!nextPath_.empty()) load(std::exchange(nextPath_, fs::path()));
  if (restoring_ && session_.model) restore(*std::exchange(restoring_, std::nullopt));
  offerRecovered();
}

// Called once, at the start: offers edits that an earlier window left behind.
void App::offerRecovered() {
  if (std::exchange(offered_, true)) return;
  const auto left = recovery_.left(options_.model);
  if (left.empty()) return;
  const Recovered& found = left.front();
  const auto since = std::chrono::file_clock::to_sys(found.time);
  const std::time_t time = std::chrono::system_clock::to_time_t(
      std::chrono::time_point_cast<std::chrono::system_clock::duration>(since));
  char when[64] = "";
  std::strftime(when, sizeof when, "%Y-%m-%d %H:%M", std::localtime(&time));
  const std::string name = found.model.empty() ? "a look" : found.model.filename().string();
  dialogs_.ask("Not saved last time",
               "Edits of " + name + " of " + when + " were not saved when the window closed.",
               {{"Restore",
                 [this, found] {
                   if (found.model.empty() || !options_.model.empty()) return restore(found);
                   restoring_ = found;
                   load(found.model);
                 }},
                {"Discard", [found] { Recovery::discard(found); }},
                {"Later", {}}});
}

void App::restore(const Recovered& found) {
  Look look = found.look;
  if (session_.model) dropMissing(look, session_.model->scene);
  session_.document.a = look;
  Recovery::discard(found);
  session_.say("restored the edits; they are not saved yet");
}

bool App::watch() {
  bool tried = false;
  if (session_.model && !loading_.valid()) {
    const FileState now = stateOf(session_.model->path);
    // A missing file is probably being replaced; it is read when it is back.
    if (now != modelState_ && now != FileState{}) {
      load(session_.model->path);
      missingSince_.reset();
    } else if (now != FileState{}) {
      missingSince_.reset();
    } else if (!missingSince_) {
      missingSince_ = Clock::now();
    } else if (!toldMissing_ && seconds(Clock::now() - *missingSince_) > 2) {
      toldMissing_ = tried = true;
      session_.fail(session_.model->path.string() +
                    " no longer exists: the model stays open; save it under a name to keep it");
    }
    if (!missingSince_) toldMissing_ = false;
  }
  if (!session_.lookPath.empty()) {
    const FileState now = stateOf(session_.lookPath);
    if (now != lookState_ && now != FileState{}) {
      lookState_ = now;
      tried = true;
      attempt([&] { session_.reloadLook(); });
    }
  }
  if (!options_.glsl.empty()) {
    const FileState now = stateOfFolder(options_.glsl);
    if (glslState_ == FileState{}) glslState_ = now;
    if (now != glslState_) {
      glslState_ = now;
      Look look = session_.document.a;
      look.resolution = resolution_;
      // Shaders that do not compile leave the picture as it was; the next change is tried.
      painter_->reload(options_.glsl, look, [this](const std::string& error) {
        if (!error.empty()) return session_.fail(error);
        requested_.reset();
        failed_.reset();
        shownResult_.request = {};
        session_.say("recompiled the shaders in " + options_.glsl.string());
      });
    }
  }
  return tried;
}

// In lower case, because cameras and other systems write .HDR.
std::string App::endingOf(const fs::path& file) {
  std::string ending = file.extension().string();
  for (char& c : ending) c = char(std::tolower(static_cast<unsigned char>(c)));
  return ending;
}

void App::openEnvironment(const std::string& path) {
  Look& look = session_.document.a;
  look.hdriFile = path;
  const std::string reason =
      withoutEffect(look, session_.model ? &session_.model->scene : nullptr, "hdri-file");
  session_.say("the environment is " + path + (reason.empty() ? "" : "; " + reason));
}

void App::openMeasured(const std::string& path) {
  attempt([&] {
    session_.measured = std::make_shared<const MeasuredMaterial>(path);
    options_.settings.panel = true;
    session_.wantedTab = 0;
    session_.say("opened " + path + ": its plot is below the material");
  });
}

void App::openLook(const fs::path& file) {
  attempt([&] {
    Look look;
    readLookFile(look, file.string());
    if (session_.model) checkMaterialNames(session_.model->scene, look);
    if (session_.lookPath != file) forgetReadFile(session_.lookPath.string());
    session_.document.a = look;
    session_.saved = session_.lookOnDisk = look;
    session_.lookPath = file;
    lookState_ = stateOf(file);
    session_.say("loaded the look " + file.string());
  });
}

void App::open(const std::string& path) {
  const fs::path file(path);
  const std::string ending = endingOf(file);
  if (ending == ".hdr" || ending == ".exr") return openEnvironment(path);
  if (ending == ".binary") return openMeasured(path);
  const bool isLook = ending == ".json" || ending == ".look";
  const auto openIt = [this, file, isLook] { isLook ? openLook(file) : load(file); };
  if (!session_.unsaved()) return openIt();
  dialogs_.ask("Not saved", "Edits are not saved. Open " + file.filename().string() + " anyway?",
               {{"Open without saving", openIt}, {"Cancel", {}}});
}

bool App::asksFirst(const std::string& path, bool sure, const std::function<void()>& replace,
                    const char* word, const std::string& question) {
  if (sure || !fs::exists(path)) return false;
  dialogs_.ask("Replace?", path + " exists. " + question, {{word, replace}, {"Cancel", {}}});
  return true;
}

void App::saveLookTo(const std::string& path, bool sure, std::function<void()> then) {
  if (asksFirst(path, sure, [this, path, then] { saveLookTo(path, true, then); })) return;
  attempt([&] {
    session_.saveLook(path, resolution_);
    lookState_ = stateOf(path);
    if (then) then();
  });
}

void App::keepPresetAt(const std::string& path, bool sure) {
  if (asksFirst(path, sure, [this, path] { keepPresetAt(path, true); })) return;
  attempt([&] {
    keepPreset(path, materialText(effectiveParameters(session_.model->scene, session_.document.a,
                                                      session_.material)));
    session_.say("kept as " + fs::path(path).stem().string());
  });
}

void App::saveModelTo(const std::string& path, bool sure) {
  // A file whose replacement was confirmed may be written again without asking.
  sure = sure || mayReplace_.contains(fs::weakly_canonical(path));
  if (asksFirst(
          path, sure, [this, path] { saveModelTo(path, true); }, "Write",
          "Write the materials into it? Everything else in it is kept."))
    return;
  attempt([&] {
    session_.saveModel(path);
    modelState_ = stateOf(session_.model->path);
    mayReplace_.insert(fs::weakly_canonical(path));
  });
}

void App::savePictureTo(const std::string& path, glm::ivec2 size, bool transparent, bool sure) {
  if (asksFirst(path, sure, [=, this] { savePictureTo(path, size, transparent, true); })) return;
  Look look = session_.lookForFile(session_.document.a);
  look.resolution = size;
  look.noBackground = transparent;
  attempt([&] {
    checkPictureName(path, {});
    painter_->save(look, path, [this, path](const std::string& error) {
      if (error.empty())
        session_.say("saved the picture as " + path);
      else
        session_.fail(error);
    });
  });
}

// A path next to the model, relative if the model's is.
std::string App::freeName(const std::string& stem, const std::string& ending) const {
  const fs::path folder = session_.model ? session_.model->path.parent_path() : fs::path();
  const fs::path name = nextFreeName(folder.empty() ? "." : folder, stem, ending).filename();
  return (folder / name).string();
}

void App::quit() {
  if (!session_.unsaved()) {
    quitting_ = true;
    return;
  }
  std::vector<Dialogs::Answer> answers;
  answers.push_back({"Save the look", [this] {
                       const auto quitNow = [this] { quitting_ = !session_.unsaved(); };
                       if (session_.lookPath.empty())
                         askLook(quitNow);
                       else
                         saveLookTo(session_.lookPath.string(), true, quitNow);
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

}  // namespace glint::viewer
