#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace glint::viewer {

/// The commands of keys, menus, buttons and the palette. The table of actions() gives each its key
/// and help, in this order.
enum class Action {
  help,
  palette,
  menu,
  toPanel,
  togglePanel,
  tabShading,
  tabLights,
  tabCamera,
  tabPicture,
  tabCompare,
  tabInfo,
  nextPlot,
  previousPlot,
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
  nextMaterial,
  previousMaterial,
  allMaterials,
  findMaterial,
  nextPreset,
  previousPreset,
  keepPreset,
  copyMaterial,
  pasteMaterial,
  resetMaterial,
  fitMeasured,
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
  switchLight,
  soloLight,
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
  turnLeft,
  turnRight,
  turnUp,
  turnDown,
  shiftLeft,
  shiftRight,
  shiftUp,
  shiftDown,
  nearer,
  farther,
  rollLeft,
  rollRight,
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
  outline,
  lightHandles,
  count,  ///< not an action: the number of actions
};

struct ActionInfo {
  Action command;
  std::string_view section, help;
  int key = 0;  ///< GLFW key code
  bool control = false, shift = false;
  bool repeats = false;  ///< while the key is held down
};

std::span<const ActionInfo> actions();

/// A menu of the bar, with the sections of the table that it contains, in this order.
struct MenuInfo {
  std::string_view name;
  std::span<const std::string_view> sections;
};
std::span<const MenuInfo> menus();

const ActionInfo& infoOf(Action);

/// "Ctrl+Shift+S".
std::string keyText(const ActionInfo&);

/// An entry of the palette: an action, or a material to select.
struct Finding {
  std::optional<Action> action;
  int material = -1;       ///< an index into the searched list; only for a material
  std::string text, keys;  ///< "Camera: front view", "1"
};

/// The actions and materials whose text, section and keys contain all the words, ignoring case;
/// those with words that begin with the searched ones come first. No words: all.
std::vector<Finding> findings(std::string_view words, std::span<const std::string> materials,
                              bool materialsAlone = false);

}  // namespace glint::viewer
