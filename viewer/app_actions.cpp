#include <algorithm>

#include "app.h"
#include "camera_control.h"
#include "edits.h"
#include "glint/image/error.h"
#include "glint/options/parameters.h"
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

}  // namespace

void App::attempt(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    session_.fail(error.what());
  }
}

void App::setCompare(CompareMode mode, bool exact) {
  Document& d = session_.document;
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

void App::execute(Action command) {
  Document& d = session_.document;
  const auto key = [&] {
    return session_.model ? materialKey(session_.model->scene, session_.material) : std::string();
  };
  if (edit(session_, command, cameraAxes())) return;
  executeCamera(command);
  const std::string stem = session_.model ? session_.model->path.stem().string() : "glint";
  const auto overlay = [&](Overlay which) {
    session_.overlay = session_.overlay == which ? Overlay::none : which;
  };
  switch (command) {
    case Action::help:
      helpShown_ = !helpShown_;
      break;
    case Action::palette:
      openPalette(false);
      break;
    case Action::menu:
      menuWanted_ = true;
      break;
    case Action::toPanel:
      options_.settings.panel = true;
      ringWanted_ = 2;
      session_.say(
          "in the panel: arrows move on, Space changes, Enter starts typing, Backspace resets, "
          "Escape leaves");
      break;
    case Action::allMaterials:
      session_.material = -1;
      session_.say("selected all materials");
      break;
    case Action::tabShading:
    case Action::tabLights:
    case Action::tabCamera:
    case Action::tabPicture:
    case Action::tabCompare:
    case Action::tabInfo:
      options_.settings.panel = true;
      session_.wantedTab = int(command) - int(Action::tabShading);
      break;
    case Action::nextPlot:
    case Action::previousPlot: {
      const int step = command == Action::nextPlot ? 1 : plotCount - 1;
      if (session_.plotShown) session_.plot = PlotView((int(session_.plot) + step) % plotCount);
      options_.settings.panel = session_.plotWanted = true;
      session_.wantedTab = 0;
      break;
    }
    case Action::findMaterial:
      openPalette(true);
      break;
    case Action::togglePanel:
      options_.settings.panel = !options_.settings.panel;
      break;
    case Action::quit:
      quit();
      break;
    case Action::open:
      dialogs_.askPath("Open a model, look, environment or measured material",
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
      dialogs_.askPath(
          "Save the look as",
          session_.lookPath.empty() ? freeName(stem, ".json") : session_.lookPath.string(), false,
          [this](const std::string& path) { saveLookTo(path, false); });
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
      savePictureTo(freeName(stem, ".png"), resolution_, d.a.noBackground, false);
      break;
    case Action::screenshotAs:
      dialogs_.askPicture(freeName(stem, ".png"), resolution_, d.a.noBackground,
                          [this](const std::string& path, glm::ivec2 size, bool transparent) {
                            savePictureTo(path, size, transparent, false);
                          });
      break;
    case Action::undo:
      if (!session_.history.undo(d, session_.playing)) session_.say("nothing to undo");
      break;
    case Action::redo:
      if (!session_.history.redo(d, session_.playing)) session_.say("nothing to redo");
      break;
    case Action::keepPreset:
      if (session_.model)
        dialogs_.askPath(
            "Keep the material as a preset",
            ownPresetPath(materialLabel(session_.model->scene, session_.material)).string(), false,
            [this](const std::string& path) { keepPresetAt(path, false); });
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
    case Action::keepAsB:
      d.b = d.a;
      d.exact = false;
      if (d.compare == CompareMode::off) d.compare = CompareMode::split;
      session_.say("kept the look as B");
      break;
    case Action::swapAB:
      if (d.b) std::swap(d.a, *d.b);
      break;
    case Action::compareSplit:
      setCompare(CompareMode::split, d.exact);
      break;
    case Action::compareBlink:
      setCompare(CompareMode::blink, d.exact);
      break;
    case Action::compareDifference:
      setCompare(CompareMode::difference, d.exact);
      break;
    case Action::compareExact:
      if (comparesExact(d))
        d.compare = CompareMode::off;
      else
        setCompare(d.compare == CompareMode::off ? CompareMode::split : d.compare, true);
      break;
    case Action::compareOff:
      d.compare = CompareMode::off;
      break;
    case Action::stronger:
    case Action::weaker:
      d.amplification =
          std::clamp(d.amplification * (command == Action::stronger ? 2 : 0.5), 1.0, 256.0);
      session_.say("difference x " + numberText(d.amplification));
      break;
    case Action::copyPixel:
      if (probe_) {
        window_.setClipboard(probeText(session_.model->scene, *probe_));
        session_.say("copied the pixel's values");
      } else {
        session_.say("point at a pixel, with the tab Info open");
      }
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
    case Action::lightHandles:
      session_.lightHandles = !session_.lightHandles;
      break;
    case Action::outline:
      overlay(Overlay::outline);
      break;
    default:  // camera commands
      break;
  }
}

void App::executeCamera(Action command) {
  Document& d = session_.document;
  if (framesAnew(command)) pivot_.reset();
  switch (command) {
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
      if (d.a.cameraOrthographic) d.a.cameraIntrinsics.reset();
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
    case Action::turnLeft:
      moveCamera([&](const Pose& p) { return orbited(p, -turnStep, 0, pivot_); });
      break;
    case Action::turnRight:
      moveCamera([&](const Pose& p) { return orbited(p, turnStep, 0, pivot_); });
      break;
    case Action::turnUp:
      moveCamera([&](const Pose& p) { return orbited(p, 0, turnStep, pivot_); });
      break;
    case Action::turnDown:
      moveCamera([&](const Pose& p) { return orbited(p, 0, -turnStep, pivot_); });
      break;
    case Action::shiftLeft:
      moveCamera([&](const Pose& p) { return panned(p, shiftStep, 0); });
      break;
    case Action::shiftRight:
      moveCamera([&](const Pose& p) { return panned(p, -shiftStep, 0); });
      break;
    case Action::shiftUp:
      moveCamera([&](const Pose& p) { return panned(p, 0, shiftStep); });
      break;
    case Action::shiftDown:
      moveCamera([&](const Pose& p) { return panned(p, 0, -shiftStep); });
      break;
    case Action::nearer:
      dolly(glm::dvec2(resolution_) / 2.0, nearerStep);
      break;
    case Action::farther:
      dolly(glm::dvec2(resolution_) / 2.0, 1 / nearerStep);
      break;
    case Action::rollLeft:
      moveCamera([&](const Pose& p) { return rolled(p, turnStep); });
      break;
    case Action::rollRight:
      moveCamera([&](const Pose& p) { return rolled(p, -turnStep); });
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
    default:
      break;
  }
}

}  // namespace glint::viewer
