#include "actions.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace glint::viewer {
namespace {

// GLFW's key codes are part of its ABI: letters and digits are ASCII.
enum Key : int {
  space = 32,
  comma = 44,
  period = 46,
  slash = 47,
  enter = 257,
  tab = 258,
  insert = 260,
  del = 261,
  rightArrow = 262,
  leftArrow = 263,
  up = 265,
  pageUp = 266,
  pageDown = 267,
  f1 = 290,
  f2 = 291,
  f8 = 297,
  f9 = 298,
  f12 = 301,
};

constexpr std::pair<int, const char*> names[] = {
    {space, "Space"},    {comma, "Comma"},      {period, "Period"},  {enter, "Enter"},
    {tab, "Tab"},        {insert, "Insert"},    {del, "Delete"},     {up, "Up"},
    {leftArrow, "Left"}, {rightArrow, "Right"}, {pageUp, "Page Up"}, {pageDown, "Page Down"},
};

constexpr bool control = true, shift = true, repeats = true, no = false;

constexpr ActionInfo actionTable[] = {
    {Action::help, "General", "show keys and mouse", slash, no, shift},
    {Action::togglePanel, "General", "hide or show the panel", f9},
    {Action::tabShading, "General", "tab Shading of the panel", f2},
    {Action::tabLights, "General", "tab Lights", f2 + 1},
    {Action::tabCamera, "General", "tab Camera", f2 + 2},
    {Action::tabPicture, "General", "tab Picture", f2 + 3},
    {Action::tabCompare, "General", "tab Compare", f2 + 4},
    {Action::tabInfo, "General", "tab Info: pixel, model, frame, shaders, log", f2 + 5},
    {Action::nextPlot, "General", "next plot: lobe, Fresnel, widths", f8},
    {Action::previousPlot, "General", "previous plot", f8, no, shift},
    {Action::quit, "General", "close the window; asks if something is not saved", 'Q'},
    {Action::open, "Files", "open a model or a look (or drop it on the window)", 'O', control},
    {Action::reload, "Files", "read the model again; the edits stay", up},
    {Action::saveLook, "Files", "save the look (for glint render --look)", 'S', control},
    {Action::saveLookAs, "Files", "save the look under a name", 'S', control, shift},
    {Action::saveModel, "Files", "save the materials into the model's file", 'M', control},
    {Action::saveModelAs, "Files", "save the model with its materials under a name", 'M', control,
     shift},
    {Action::screenshot, "Files", "save the picture as PNG under the next free name", f12},
    {Action::screenshotAs, "Files", "save the picture under a name", f12, no, shift},
    {Action::undo, "Edit", "undo", 'Z', control, no, repeats},
    {Action::redo, "Edit", "redo (also Ctrl+Y)", 'Z', control, shift, repeats},
    {Action::nextMaterial, "Material", "select the next one", pageDown, no, no, repeats},
    {Action::previousMaterial, "Material", "select the previous one", pageUp, no, no, repeats},
    {Action::findMaterial, "Material", "find one by name", 'F', control},
    {Action::nextPreset, "Material", "next preset", 'M', no, no, repeats},
    {Action::previousPreset, "Material", "previous preset", 'M', no, shift, repeats},
    {Action::copyMaterial, "Material", "copy as text", 'C', control},
    {Action::pasteMaterial, "Material", "paste from text", 'V', control},
    {Action::resetMaterial, "Material", "take back all edits", 'R', control},
    {Action::copyPixel, "Material", "copy the values of the pixel under the cursor", 'C', control,
     shift},
    {Action::nextProgram, "Shading", "next program", 'P'},
    {Action::nextHighlight, "Shading", "next form of the highlight", 'J'},
    {Action::nextFresnel, "Shading", "next form of the reflectance", 'J', no, shift},
    {Action::maxError, "Shading", "cheapest forms within an error, on or off", 'P', no, shift},
    {Action::viewer, "Shading", "viewer near or infinitely far", 'V'},
    {Action::twoSided, "Shading", "back faces, on or off", 'T'},
    {Action::brighter, "Lights", "brighter, all of them", 'L', no, no, repeats},
    {Action::darker, "Lights", "darker", 'L', no, shift, repeats},
    {Action::nextLight, "Lights", "select the next one", 'G'},
    {Action::addLight, "Lights", "one more", insert},
    {Action::removeLight, "Lights", "remove the selected one", del},
    {Action::defaultLights, "Lights", "the file's again, or the default one", del, no, shift},
    {Action::noLights, "Lights", "ambient light alone, on or off", 'L', control},
    {Action::nextEnvironment, "Lights", "next environment", 'Y'},
    {Action::environmentBackground, "Lights", "environment as background, on or off", 'Y', no,
     shift},
    {Action::exposureUp, "Picture", "exposure up a quarter EV", 'X', no, no, repeats},
    {Action::exposureDown, "Picture", "exposure down", 'X', no, shift, repeats},
    {Action::noBackground, "Picture", "transparent background, on or off", 'U'},
    {Action::antiAliasing, "Picture", "next anti-aliasing", 'A'},
    {Action::front, "Camera", "front view", '1'},
    {Action::back, "Camera", "back view", '1', control},
    {Action::right, "Camera", "right view", '3'},
    {Action::left, "Camera", "left view", '3', control},
    {Action::top, "Camera", "top view", '7'},
    {Action::bottom, "Camera", "bottom view", '7', control},
    {Action::isometric, "Camera", "isometric view", '9'},
    {Action::orthographic, "Camera", "parallel projection, on or off", '5'},
    {Action::fit, "Camera", "show the whole model from here", 'F'},
    {Action::resetCamera, "Camera", "first view again", enter},
    {Action::nextCamera, "Camera", "next camera of the file", 'W', no, shift},
    {Action::play, "Animation", "play, or stop", space},
    {Action::earlier, "Animation", "a tenth of a second back", leftArrow, no, no, repeats},
    {Action::later, "Animation", "a tenth of a second on", rightArrow, no, no, repeats},
    {Action::nextAnimation, "Animation", "next one of the file", 'W'},
    {Action::keepAsB, "Compare", "keep the look as B", 'B'},
    {Action::swapAB, "Compare", "exchange A and B", 'B', no, shift},
    {Action::compareSplit, "Compare", "A and B side by side; drag the divider", 'S'},
    {Action::compareBlink, "Compare", "B in place of A, on or off", tab},
    {Action::compareDifference, "Compare", "difference of A and B", 'D'},
    {Action::compareExact, "Compare", "compare with the exact reference in place of B", 'R'},
    {Action::compareOff, "Compare", "A alone", 'A', no, shift},
    {Action::stronger, "Compare", "difference twice as strong", period, no, no, repeats},
    {Action::weaker, "Compare", "difference half as strong", comma, no, no, repeats},
    {Action::wireframe, "Overlays", "edges", 'E'},
    {Action::normals, "Overlays", "normals as colours", 'N'},
    {Action::facing, "Overlays", "front faces blue, back faces red", 'K'},
    {Action::clipped, "Overlays", "pixels that are clipped, or not numbers", 'C'},
};

}  // namespace

std::span<const ActionInfo> actions() { return actionTable; }

const ActionInfo& infoOf(Action command) {
  return *std::find_if(std::begin(actionTable), std::end(actionTable),
                       [&](const ActionInfo& i) { return i.command == command; });
}

std::string keyText(const ActionInfo& info) {
  if (info.command == Action::help) return "? or H, F1";
  std::string text = info.control ? "Ctrl+" : "";
  if (info.shift) text += "Shift+";
  for (const auto& [key, name] : names)
    if (key == info.key) return text + name;
  if (info.key >= f1 && info.key <= f12) return text + "F" + std::to_string(info.key - f1 + 1);
  return text + char(info.key);
}

}  // namespace glint::viewer
