#include <algorithm>

#include "app.h"
#include "camera_control.h"
#include "edits.h"
#include "glint/image/error.h"
#include "glint/options/parameters.h"
#include "glint/scene/camera.h"
#include "glint/scene/look_text.h"
#include "materials.h"
#include "own_presets.h"

namespace glint::viewer {
namespace {

// How far one key press moves the camera.
constexpr double turnStep = 5, shiftStep = 0.05,
                 nearerStep = 0.9;  // degrees; of the picture's height; factor

bool framesAnew(Action command) {
  return (command >= Action::front && command <= Action::isometric) || command == Action::fit ||
         command == Action::resetCamera || command == Action::nextCamera;
}

void toggle(Session& session, Overlay which) {
  session.overlay = session.overlay == which ? Overlay::none : which;
}

void amplify(Session& session, double factor) {
  double& amplification = session.document.amplification;
  amplification = std::clamp(amplification * factor, 1.0, 256.0);
  session.say("difference x " + numberText(amplification));
}

void nextCamera(Session& session) {
  const std::vector<int> cameras =
      session.model ? usableCameras(session.model->scene) : std::vector<int>();
  if (cameras.empty()) return session.say("the file has no camera");
  Look& look = session.document.a;
  const auto next = std::ranges::upper_bound(cameras, look.cameraIndex.value_or(-1));
  resetCamera(look);
  if (next != cameras.end()) look.cameraIndex = *next;
}

}  // namespace

void App::attempt(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    session_.fail(error.what());
  }
}

void App::setCompare(CompareMode mode, bool alsoExact) {
  Document& d = session_.document;
  const bool exact = alsoExact || d.exact;
  if (!exact && !d.b) {
    session_.say("keep a look as B first (B), or compare with the exact reference (R)");
    return;
  }
  d.compare = d.compare == mode && d.exact == exact ? CompareMode::off : mode;
  d.exact = exact;
}

void App::pick(glm::dvec2 pixel) {
  if (!session_.model) return;
  const auto hit = hitAt(pixel);
  if (!hit) {
    const std::string key = keyText(infoOf(Action::allMaterials));
    return session_.say(
        "no surface there: " + materialLabel(session_.model->scene, session_.material) +
        (session_.material < 0 ? " stay" : " stays") + " selected (" + key + ": all)");
  }
  session_.material = hit->material;
  session_.say("selected " + materialLabel(session_.model->scene, session_.material));
}

glm::dmat3 App::cameraAxes() const {
  return shownResult_.a ? shownResult_.a->list.camera.axes : glm::dmat3(1.0);
}

std::string App::stem() const {
  return session_.model ? session_.model->path.stem().string() : "glint";
}

void App::askLook(const std::function<void()>& then) {
  dialogs_.askPath(
      "Save the look as",
      session_.lookPath.empty() ? freeName(stem(), ".json") : session_.lookPath.string(), false,
      [this, then](const std::string& path) { saveLookTo(path, false, then); });
}

void App::showPlot(int step) {
  if (session_.plotShown) session_.plot = PlotView((int(session_.plot) + step) % plotCount);
  options_.settings.panel = session_.plotWanted = true;
  session_.wantedTab = 0;
}

void App::turnCamera(double right, double up) {
  moveCamera([&](const Pose& p) { return orbited(p, right, up, pivot_); });
}

void App::execute(Action command) {
  if (edit(session_, command, cameraAxes())) return;
  if (framesAnew(command)) pivot_.reset();
  if (command >= Action::front && command <= Action::isometric)
    return setView(session_.document.a, StandardView(int(command) - int(Action::front)));
  if (command >= Action::tabShading && command <= Action::tabInfo) {
    options_.settings.panel = true;
    session_.wantedTab = int(command) - int(Action::tabShading);
    return;
  }
  static constexpr std::pair<Action, void (*)(App&)> table[] = {
      {Action::help, [](App& a) { a.helpShown_ = !a.helpShown_; }},
      {Action::palette, [](App& a) { a.openPalette(false); }},
      {Action::menu, [](App& a) { a.menuWanted_ = true; }},
      {Action::toPanel,
       [](App& a) {
         a.options_.settings.panel = true;
         a.ringWanted_ = 2;
         a.session_.say(
             "in the panel: arrows move on, Space changes, Enter starts typing, Backspace resets, "
             "Escape leaves");
       }},
      {Action::allMaterials,
       [](App& a) {
         a.session_.material = -1;
         a.session_.say("selected all materials");
       }},
      {Action::nextPlot, [](App& a) { a.showPlot(1); }},
      {Action::previousPlot, [](App& a) { a.showPlot(plotCount - 1); }},
      {Action::findMaterial, [](App& a) { a.openPalette(true); }},
      {Action::togglePanel, [](App& a) { a.options_.settings.panel = !a.options_.settings.panel; }},
      {Action::quit, [](App& a) { a.quit(); }},
      {Action::open,
       [](App& a) {
         const auto& model = a.session_.model;
         a.dialogs_.askPath("Open a model, look, environment or measured material",
                            model && model->path.has_parent_path()
                                ? model->path.parent_path().string() + "/"
                                : "./",
                            true, [&a](const std::string& path) { a.open(path); });
       }},
      {Action::reload,
       [](App& a) {
         if (a.session_.model) a.load(a.session_.model->path);
       }},
      {Action::saveLook,
       [](App& a) {
         if (a.session_.lookPath.empty())
           a.askLook();
         else
           a.saveLookTo(a.session_.lookPath.string(), true);
       }},
      {Action::saveLookAs, [](App& a) { a.askLook(); }},
      {Action::saveModel,
       [](App& a) {
         if (a.session_.model) a.saveModelTo(a.session_.model->path.string(), false);
       }},
      {Action::saveModelAs,
       [](App& a) {
         if (a.session_.model)
           a.dialogs_.askPath("Save the model with its materials as",
                              a.session_.model->path.string(), false,
                              [&a](const std::string& path) { a.saveModelTo(path, false); });
       }},
      {Action::screenshot,
       [](App& a) {
         a.savePictureTo(a.freeName(a.stem(), ".png"), a.resolution_,
                         a.session_.document.a.noBackground, false);
       }},
      {Action::screenshotAs,
       [](App& a) {
         a.dialogs_.askPicture(a.freeName(a.stem(), ".png"), a.resolution_,
                               a.session_.document.a.noBackground,
                               [&a](const std::string& path, glm::ivec2 size, bool transparent) {
                                 a.savePictureTo(path, size, transparent, false);
                               });
       }},
      {Action::undo,
       [](App& a) {
         if (!a.session_.history.undo(a.session_.document, a.session_.playing))
           a.session_.say("nothing to undo");
       }},
      {Action::redo,
       [](App& a) {
         if (!a.session_.history.redo(a.session_.document, a.session_.playing))
           a.session_.say("nothing to redo");
       }},
      {Action::keepPreset,
       [](App& a) {
         const auto& model = a.session_.model;
         if (model)
           a.dialogs_.askPath(
               "Keep the material as a preset",
               ownPresetPath(materialLabel(model->scene, a.session_.material)).string(), false,
               [&a](const std::string& path) { a.keepPresetAt(path, false); });
       }},
      {Action::copyMaterial,
       [](App& a) {
         Session& s = a.session_;
         if (!s.model) return;
         a.window_.setClipboard(
             materialText(effectiveParameters(s.model->scene, s.document.a, s.material)));
         s.say("copied " + materialLabel(s.model->scene, s.material));
       }},
      {Action::pasteMaterial,
       [](App& a) {
         Session& s = a.session_;
         if (!s.model) return;
         a.attempt([&] {
           pasteMaterial(s.document.a, materialKey(s.model->scene, s.material),
                         a.window_.clipboard());
           s.say("pasted");
         });
       }},
      {Action::keepAsB,
       [](App& a) {
         Document& d = a.session_.document;
         d.b = d.a;
         d.exact = false;
         if (d.compare == CompareMode::off) d.compare = CompareMode::split;
         a.session_.say("kept the look as B");
       }},
      {Action::swapAB,
       [](App& a) {
         Document& d = a.session_.document;
         if (d.b) std::swap(d.a, *d.b);
       }},
      {Action::compareSplit, [](App& a) { a.setCompare(CompareMode::split); }},
      {Action::compareBlink, [](App& a) { a.setCompare(CompareMode::blink); }},
      {Action::compareDifference, [](App& a) { a.setCompare(CompareMode::difference); }},
      {Action::compareExact,
       [](App& a) {
         Document& d = a.session_.document;
         if (comparesExact(d))
           d.compare = CompareMode::off;
         else
           a.setCompare(d.compare == CompareMode::off ? CompareMode::split : d.compare, true);
       }},
      {Action::compareOff, [](App& a) { a.session_.document.compare = CompareMode::off; }},
      {Action::stronger, [](App& a) { amplify(a.session_, 2); }},
      {Action::weaker, [](App& a) { amplify(a.session_, 0.5); }},
      {Action::copyPixel,
       [](App& a) {
         if (!a.probe_) return a.session_.say("point at a pixel, with the tab Info open");
         a.window_.setClipboard(probeText(a.session_.model->scene, *a.probe_));
         a.session_.say("copied the pixel's values");
       }},
      {Action::wireframe, [](App& a) { toggle(a.session_, Overlay::wireframe); }},
      {Action::normals, [](App& a) { toggle(a.session_, Overlay::normals); }},
      {Action::facing, [](App& a) { toggle(a.session_, Overlay::facing); }},
      {Action::clipped, [](App& a) { toggle(a.session_, Overlay::clipped); }},
      {Action::lightHandles, [](App& a) { a.session_.lightHandles = !a.session_.lightHandles; }},
      {Action::outline, [](App& a) { toggle(a.session_, Overlay::outline); }},
      {Action::orthographic,
       [](App& a) {
         Look& look = a.session_.document.a;
         look.cameraOrthographic = !look.cameraOrthographic;
         if (look.cameraOrthographic) look.cameraIntrinsics.reset();
       }},
      {Action::fit,
       [](App& a) {
         if (!a.session_.model) return;
         a.attempt([&] {
           Look look = a.session_.document.a;
           look.resolution = a.resolution_;
           fit(look, a.session_.model->scene, a.session_.model->bounds);
           look.resolution = a.session_.document.a.resolution;
           a.session_.document.a = look;
         });
       }},
      {Action::resetCamera, [](App& a) { resetCamera(a.session_.document.a); }},
      {Action::turnLeft, [](App& a) { a.turnCamera(-turnStep, 0); }},
      {Action::turnRight, [](App& a) { a.turnCamera(turnStep, 0); }},
      {Action::turnUp, [](App& a) { a.turnCamera(0, turnStep); }},
      {Action::turnDown, [](App& a) { a.turnCamera(0, -turnStep); }},
      {Action::shiftLeft,
       [](App& a) { a.moveCamera([](const Pose& p) { return panned(p, shiftStep, 0); }); }},
      {Action::shiftRight,
       [](App& a) { a.moveCamera([](const Pose& p) { return panned(p, -shiftStep, 0); }); }},
      {Action::shiftUp,
       [](App& a) { a.moveCamera([](const Pose& p) { return panned(p, 0, shiftStep); }); }},
      {Action::shiftDown,
       [](App& a) { a.moveCamera([](const Pose& p) { return panned(p, 0, -shiftStep); }); }},
      {Action::nearer, [](App& a) { a.dolly(glm::dvec2(a.resolution_) / 2.0, nearerStep); }},
      {Action::farther, [](App& a) { a.dolly(glm::dvec2(a.resolution_) / 2.0, 1 / nearerStep); }},
      {Action::rollLeft,
       [](App& a) { a.moveCamera([](const Pose& p) { return rolled(p, turnStep); }); }},
      {Action::rollRight,
       [](App& a) { a.moveCamera([](const Pose& p) { return rolled(p, -turnStep); }); }},
      {Action::nextCamera, [](App& a) { nextCamera(a.session_); }},
  };
  const auto* found = std::ranges::find(table, command, &std::pair<Action, void (*)(App&)>::first);
  if (found != std::end(table)) found->second(*this);
}

}  // namespace glint::viewer
