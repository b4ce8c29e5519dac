#include "actions.h"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <sstream>
#include <utility>

namespace glint::viewer {
namespace {

// GLFW's key codes are part of its ABI: letters and digits are ASCII.
enum Key : int {
  space = 32,
  comma = 44,
  minus = 45,
  period = 46,
  slash = 47,
  equal = 61,
  bracketLeft = 91,
  bracketRight = 93,
  enter = 257,
  tab = 258,
  insert = 260,
  del = 261,
  rightArrow = 262,
  leftArrow = 263,
  down = 264,
  up = 265,
  pageUp = 266,
  pageDown = 267,
  f1 = 290,
  f2 = 291,
  f8 = 297,
  f9 = 298,
  f10 = 299,
  f12 = 301,
};

constexpr std::pair<int, const char*> names[] = {
    {space, "Space"},    {comma, "Comma"},      {period, "Period"},  {enter, "Enter"},
    {tab, "Tab"},        {insert, "Insert"},    {del, "Delete"},     {up, "Up"},
    {leftArrow, "Left"}, {rightArrow, "Right"}, {pageUp, "Page Up"}, {pageDown, "Page Down"},
    {minus, "-"},        {equal, "="},          {down, "Down"},      {bracketLeft, "["},
    {bracketRight, "]"},
};

constexpr bool control = true, shift = true, repeats = true, no = false;

constexpr ActionInfo actionTable[] = {
    {Action::help, "Help", "show keys and mouse", slash, no, shift},
    {Action::palette, "Help", "find an action or a material by name", 'P', control},
    {Action::menu, "Help", "open the menu", f10},
    {Action::toPanel, "Panel", "go to the panel: arrows, Space and Enter work in it", down},
    {Action::togglePanel, "Panel", "hide or show the panel", f9},
    {Action::tabShading, "Panel", "tab Shading", f2},
    {Action::tabLights, "Panel", "tab Lights", f2 + 1},
    {Action::tabCamera, "Panel", "tab Camera", f2 + 2},
    {Action::tabPicture, "Panel", "tab Picture", f2 + 3},
    {Action::tabCompare, "Panel", "tab Compare", f2 + 4},
    {Action::tabInfo, "Panel", "tab Info: pixel, model, frame, shaders, log", f2 + 5},
    {Action::nextPlot, "Panel", "next plot: lobe, Fresnel, widths", f8},
    {Action::previousPlot, "Panel", "previous plot", f8, no, shift},
    {Action::open, "Files", "open a model, look, environment or measured material (or drop it)",
     'O', control},
    {Action::reload, "Files", "reload the model; edits are kept", up},
    {Action::saveLook, "Files", "save the look (for glint render --look)", 'S', control},
    {Action::saveLookAs, "Files", "save the look as", 'S', control, shift},
    {Action::saveModel, "Files", "save the materials into the model's file", 'M', control},
    {Action::saveModelAs, "Files", "save the model with its materials as", 'M', control, shift},
    {Action::screenshot, "Files", "save the picture as PNG under the next free name", f12},
    {Action::screenshotAs, "Files", "save the picture as", f12, no, shift},
    {Action::quit, "Files", "close the window; asks if something is not saved", 'Q'},
    {Action::undo, "Edit", "undo", 'Z', control, no, repeats},
    {Action::redo, "Edit", "redo (also Ctrl+Y)", 'Z', control, shift, repeats},
    {Action::nextMaterial, "Material", "select the next material", pageDown, no, no, repeats},
    {Action::previousMaterial, "Material", "select the previous material", pageUp, no, no, repeats},
    {Action::allMaterials, "Material", "select all materials", 'A', control},
    {Action::findMaterial, "Material", "find a material by name", 'F', control},
    {Action::nextPreset, "Material", "next preset", 'M', no, no, repeats},
    {Action::previousPreset, "Material", "previous preset", 'M', no, shift, repeats},
    {Action::keepPreset, "Material", "keep as a preset", 'K', control},
    {Action::copyMaterial, "Material", "copy the material as text", 'C', control},
    {Action::pasteMaterial, "Material", "paste a material from text", 'V', control},
    {Action::resetMaterial, "Material", "undo all edits of the material", 'R', control},
    {Action::fitMeasured, "Material", "fit to the open measured material", 'F', no, shift},
    {Action::copyPixel, "Material", "copy the values of the pixel under the cursor", 'C', control,
     shift},
    {Action::nextProgram, "Shading", "next program", 'P'},
    {Action::nextHighlight, "Shading", "next form of the highlight", 'J'},
    {Action::nextFresnel, "Shading", "next form of the reflectance", 'J', no, shift},
    {Action::maxError, "Shading", "cheapest forms within an error, on or off", 'P', no, shift},
    {Action::viewer, "Shading", "local or infinite viewer", 'V'},
    {Action::twoSided, "Shading", "back faces, on or off", 'T'},
    {Action::brighter, "Lights", "all lights brighter", 'L', no, no, repeats},
    {Action::darker, "Lights", "all lights darker", 'L', no, shift, repeats},
    {Action::nextLight, "Lights", "select the next light", 'G'},
    {Action::addLight, "Lights", "add a light", insert},
    {Action::removeLight, "Lights", "remove the selected light", del},
    {Action::switchLight, "Lights", "switch the selected light off, or on again", 'Z'},
    {Action::soloLight, "Lights", "solo the selected light, or all again", 'Z', no, shift},
    {Action::defaultLights, "Lights", "back to the file's lights, or the default one", del, no,
     shift},
    {Action::noLights, "Lights", "only ambient light, on or off", 'L', control},
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
    {Action::resetCamera, "Camera", "reset the view", enter},
    {Action::nextCamera, "Camera", "next camera of the file", 'W', no, shift},
    {Action::turnLeft, "Camera", "turn to the left", leftArrow, no, shift, repeats},
    {Action::turnRight, "Camera", "turn to the right", rightArrow, no, shift, repeats},
    {Action::turnUp, "Camera", "turn upwards", up, no, shift, repeats},
    {Action::turnDown, "Camera", "turn downwards", down, no, shift, repeats},
    {Action::shiftLeft, "Camera", "move to the left", leftArrow, control, no, repeats},
    {Action::shiftRight, "Camera", "move to the right", rightArrow, control, no, repeats},
    {Action::shiftUp, "Camera", "move upwards", up, control, no, repeats},
    {Action::shiftDown, "Camera", "move downwards", down, control, no, repeats},
    {Action::nearer, "Camera", "zoom in to the middle of the view", equal, no, no, repeats},
    {Action::farther, "Camera", "zoom out", minus, no, no, repeats},
    {Action::rollLeft, "Camera", "roll to the left", bracketLeft, no, no, repeats},
    {Action::rollRight, "Camera", "roll to the right", bracketRight, no, no, repeats},
    {Action::play, "Animation", "play, or stop", space},
    {Action::earlier, "Animation", "a tenth of a second back", leftArrow, no, no, repeats},
    {Action::later, "Animation", "a tenth of a second forward", rightArrow, no, no, repeats},
    {Action::nextAnimation, "Animation", "next animation of the file", 'W'},
    {Action::keepAsB, "Compare", "keep the look as B", 'B'},
    {Action::swapAB, "Compare", "swap A and B", 'B', no, shift},
    {Action::compareSplit, "Compare", "A and B side by side; drag the divider", 'S'},
    {Action::compareBlink, "Compare", "show B instead of A, on or off", tab},
    {Action::compareDifference, "Compare", "difference of A and B", 'D'},
    {Action::compareExact, "Compare", "compare with the exact reference instead of B", 'R'},
    {Action::compareOff, "Compare", "only A", 'A', no, shift},
    {Action::stronger, "Compare", "difference twice as strong", period, no, no, repeats},
    {Action::weaker, "Compare", "difference half as strong", comma, no, no, repeats},
    {Action::wireframe, "Overlays", "edges", 'E'},
    {Action::normals, "Overlays", "normals as colours", 'N'},
    {Action::facing, "Overlays", "front faces blue, back faces red", 'K'},
    {Action::clipped, "Overlays", "clipped pixels and pixels that are not numbers", 'C'},
    {Action::outline, "Overlays", "outline of the selected material", 'I'},
    {Action::lightHandles, "Overlays", "handles for dragging lights", 'O'},
};

}  // namespace

std::span<const ActionInfo> actions() { return actionTable; }

const ActionInfo& infoOf(Action command) {
  return *std::find_if(std::begin(actionTable), std::end(actionTable),
                       [&](const ActionInfo& i) { return i.command == command; });
}

std::span<const MenuInfo> menus() {
  static constexpr std::string_view file[] = {"Files"}, edit[] = {"Edit"},
                                    material[] = {"Material", "Shading"}, light[] = {"Lights"},
                                    camera[] = {"Camera", "Animation"},
                                    view[] = {"Picture", "Overlays"}, compare[] = {"Compare"},
                                    panel[] = {"Panel"}, help[] = {"Help"};
  static constexpr MenuInfo table[] = {
      {"File", file},       {"Edit", edit},     {"Material", material},
      {"Light", light},     {"Camera", camera}, {"View", view},
      {"Compare", compare}, {"Panel", panel},   {"Help", help}};
  return table;
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

namespace {

std::string lower(std::string_view text) {
  std::string lowered(text);
  for (char& c : lowered)
    if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
  return lowered;
}

std::vector<std::string> wordsOf(std::string_view text) {
  std::istringstream stream(lower(text));
  return {std::istream_iterator<std::string>(stream), {}};
}

// 0: a word does not occur; 1: all occur; 2: each is the beginning of a word.
int match(const std::vector<std::string>& words, const std::string& text) {
  int best = 2;
  for (const std::string& word : words) {
    bool begins = false, occurs = false;
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
      occurs = true;
      begins = begins || at == 0 || !std::isalnum(static_cast<unsigned char>(text[at - 1]));
    }
    if (!occurs) return 0;
    if (!begins) best = 1;
  }
  return best;
}

}  // namespace

std::vector<Finding> findings(std::string_view text, std::span<const std::string> materials,
                              bool materialsAlone) {
  const std::vector<std::string> words = wordsOf(text);
  std::vector<Finding> found[2];
  const auto consider = [&](Finding finding, const std::string& searched) {
    if (const int m = match(words, lower(searched))) found[2 - m].push_back(std::move(finding));
  };
  if (!materialsAlone)
    for (const ActionInfo& info : actionTable) {
      const std::string shown = std::string(info.section) + ": " + std::string(info.help);
      consider({info.command, -1, shown, keyText(info)}, shown + " " + keyText(info));
    }
  for (std::size_t i = 0; i < materials.size(); ++i)
    consider({{}, int(i), "Material: " + materials[i], {}}, "material " + materials[i]);
  std::ranges::move(found[1], std::back_inserter(found[0]));
  return std::move(found[0]);
}

}  // namespace glint::viewer
