#pragma once

#include <span>
#include <string>
#include <string_view>

namespace glint::viewer {

/// What keys and buttons do. The one table of actions() gives each its key and its help, in this
/// order.
enum class Action {
  help,
  togglePanel,
  tabShading,
  tabLights,
  tabCamera,
  tabPicture,
  tabCompare,
  tabInfo,
  nextPlot,
  previousPlot,
  quit,
  open,
  reload,
  saveLook,
  saveLookAs,
  saveModel,
  saveModelAs,
  screenshot,
  screenshotAs,
  undo,
  redo,
  nextMaterial,
  previousMaterial,
  findMaterial,
  nextPreset,
  previousPreset,
  copyMaterial,
  pasteMaterial,
  resetMaterial,
  copyPixel,
  nextProgram,
  nextHighlight,
  nextFresnel,
  maxError,
  viewer,
  twoSided,
  brighter,
  darker,
  nextLight,
  addLight,
  removeLight,
  defaultLights,
  noLights,
  nextEnvironment,
  environmentBackground,
  exposureUp,
  exposureDown,
  noBackground,
  antiAliasing,
  front,
  back,
  right,
  left,
  top,
  bottom,
  isometric,
  orthographic,
  fit,
  resetCamera,
  nextCamera,
  play,
  earlier,
  later,
  nextAnimation,
  keepAsB,
  swapAB,
  compareSplit,
  compareBlink,
  compareDifference,
  compareExact,
  compareOff,
  stronger,
  weaker,
  wireframe,
  normals,
  facing,
  clipped,
  count,  ///< none: how many there are
};

struct ActionInfo {
  Action command;
  std::string_view section, help;
  int key = 0;  ///< GLFW's key code
  bool control = false, shift = false;
  bool repeats = false;  ///< while the key is held
};

std::span<const ActionInfo> actions();
const ActionInfo& infoOf(Action);

/// "Ctrl+Shift+S".
std::string keyText(const ActionInfo&);

}  // namespace glint::viewer
