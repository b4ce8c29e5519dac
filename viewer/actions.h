#pragma once

#include <span>
#include <string>
#include <string_view>

namespace glint {

/// What keys and buttons do. The one table of actions() names them; help is made from it.
enum class Action {
  help,
  open,
  reload,
  saveLook,
  saveLookAs,
  saveModel,
  saveModelAs,
  screenshot,
  screenshotAs,
  quit,
  undo,
  redo,
  copyMaterial,
  pasteMaterial,
  resetMaterial,
  fit,
  resetCamera,
  front,
  back,
  right,
  left,
  top,
  bottom,
  isometric,
  orthographic,
  nextCamera,
  keepAsB,
  swapAB,
  compareSplit,
  compareBlink,
  compareDifference,
  compareOff,
  compareExact,
  wireframe,
  normals,
  facing,
  clipped,
  nextProgram,
  togglePanel,
  tabShading,
  tabLights,
  tabCamera,
  tabPicture,
  tabCompare,
  tabInfo,
  copyPixel,
};

struct ActionInfo {
  Action command;
  std::string_view section, help;
  int key = 0;  ///< GLFW's key code
  bool control = false, shift = false;
};

std::span<const ActionInfo> actions();
const ActionInfo& infoOf(Action);

/// "Ctrl+Shift+S".
std::string keyText(const ActionInfo&);

}  // namespace glint
