#include "actions.h"

#include <algorithm>
#include <iterator>

namespace glint {
namespace {

// GLFW's key codes are part of its ABI: letters and digits are ASCII.
enum Key : int {
  slash = 47,
  escape = 256,
  enter = 257,
  tab = 258,
  up = 265,
  f1 = 290,
  f2 = 291,
  f9 = 298,
  f12 = 301,
};

constexpr ActionInfo table[] = {
    {Action::help, "General", "show keys and mouse", slash, false, true},
    {Action::togglePanel, "General", "hide or show the panel", f9},
    {Action::tabShading, "General", "tab Shading of the panel", f2},
    {Action::tabLights, "General", "tab Lights", f2 + 1},
    {Action::tabCamera, "General", "tab Camera", f2 + 2},
    {Action::tabPicture, "General", "tab Picture", f2 + 3},
    {Action::tabCompare, "General", "tab Compare", f2 + 4},
    {Action::tabInfo, "General", "tab Info", f2 + 5},
    {Action::quit, "General", "close the window; asks if something is not saved", 'Q'},
    {Action::open, "Files", "open a model or a look (or drop it on the window)", 'O', true},
    {Action::reload, "Files", "read the model again; the edits stay", up},
    {Action::saveLook, "Files", "save the look (for glint render --look)", 'S', true},
    {Action::saveLookAs, "Files", "save the look under a name", 'S', true, true},
    {Action::saveModel, "Files", "save the materials into the model's file", 'M', true},
    {Action::saveModelAs, "Files", "save the model with its materials under a name", 'M', true,
     true},
    {Action::screenshot, "Files", "save the picture as PNG under the next free name", f12},
    {Action::screenshotAs, "Files", "save the picture under a name", f12, false, true},
    {Action::undo, "Edit", "undo", 'Z', true},
    {Action::redo, "Edit", "redo", 'Z', true, true},
    {Action::copyMaterial, "Edit", "copy the selected material as text", 'C', true},
    {Action::pasteMaterial, "Edit", "paste a material from text", 'V', true},
    {Action::resetMaterial, "Edit", "take back all edits of the selected material", 'R', true},
    {Action::copyPixel, "Edit", "copy the values of the pixel under the cursor as text", 'C', true,
     true},
    {Action::nextProgram, "Edit", "next shading program", 'P'},
    {Action::front, "Camera", "front view", '1'},
    {Action::back, "Camera", "back view", '1', true},
    {Action::right, "Camera", "right view", '3'},
    {Action::left, "Camera", "left view", '3', true},
    {Action::top, "Camera", "top view", '7'},
    {Action::bottom, "Camera", "bottom view", '7', true},
    {Action::isometric, "Camera", "isometric view", '9'},
    {Action::orthographic, "Camera", "parallel projection, on or off", '5'},
    {Action::fit, "Camera", "show the whole model from here", 'F'},
    {Action::resetCamera, "Camera", "first view again", enter},
    {Action::nextCamera, "Camera", "next camera of the file", 'W'},
    {Action::keepAsB, "Compare", "keep the look as B", 'B'},
    {Action::swapAB, "Compare", "exchange A and B", 'B', false, true},
    {Action::compareSplit, "Compare", "A and B side by side; drag the divider", 'S'},
    {Action::compareBlink, "Compare", "B in place of A, on or off", tab},
    {Action::compareDifference, "Compare", "difference of A and B", 'D'},
    {Action::compareExact, "Compare", "compare with the exact reference in place of B", 'R'},
    {Action::compareOff, "Compare", "A alone", 'A'},
    {Action::wireframe, "Overlays", "edges", 'E'},
    {Action::normals, "Overlays", "normals as colours", 'N'},
    {Action::facing, "Overlays", "front faces blue, back faces red", 'K'},
    {Action::clipped, "Overlays", "pixels that are clipped, or not numbers", 'C'},
};

}  // namespace

std::span<const ActionInfo> actions() { return table; }

const ActionInfo& infoOf(Action command) {
  return *std::find_if(std::begin(table), std::end(table),
                       [&](const ActionInfo& i) { return i.command == command; });
}

std::string keyText(const ActionInfo& info) {
  std::string text = info.control ? "Ctrl+" : "";
  if (info.command == Action::help) return "? or F1";
  if (info.shift) text += "Shift+";
  switch (info.key) {
    case enter:
      return text + "Enter";
    case tab:
      return text + "Tab";
    case up:
      return text + "Up";
    default:
      if (info.key >= f1 && info.key <= f12) return text + "F" + std::to_string(info.key - f1 + 1);
      return text + char(info.key);
  }
}

}  // namespace glint
