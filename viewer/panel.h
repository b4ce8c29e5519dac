#pragma once

#include <functional>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

#include "actions.h"
#include "picture.h"
#include "plots.h"
#include "probe.h"
#include "session.h"
#include "settings.h"
#include "thumbnails.h"

namespace glint::viewer {

/// What the panel shows and the actions that it can request.
struct PanelContext {
  Session& session;
  Settings& settings;
  const DrawnPicture* picture = nullptr;  ///< null until one is drawn
  glm::ivec2 resolution{1};               ///< of the picture in the window
  bool preview = false;                   ///< a smaller one is shown while something moves
  const Probe* probe = nullptr;           ///< for the pixel under the cursor, or null
  bool* probeShown = nullptr;             ///< set to true when the panel shows it
  std::string comparison = {};            ///< the difference between A and B or the reference
  Thumbnails* thumbnails = nullptr;       ///< of textures
  double uiMilliseconds = 0;              ///< time for the panel's last frame
  std::function<void(Action)> run = {};
  std::function<void(glm::ivec2)> resizePicture = {};
};

/// All tabs, within the current ImGui window.
void drawPanel(PanelContext&);

// The tabs.
void drawShadingTab(PanelContext&);
void drawLightsTab(PanelContext&);
void drawCameraTab(PanelContext&);
void drawPictureTab(PanelContext&);
void drawCompareTab(PanelContext&);
void drawInfoTab(PanelContext&);

/// What max-error and the shading auto chose for the picture, and why; nothing if the look leaves
/// nothing open.
void drawChoice(PanelContext&);

/// The plots of the selected material, below its sliders.
void drawPlots(PanelContext&);

/// The plot of the lobe, in the view that the settings select.
void drawLobe(Settings&, const LobeInput&);

/// The list of materials, and the parameters of the selected one.
void drawMaterials(PanelContext&);

/// The textures of the selected material, and what they affect.
void drawTextures(PanelContext&);

/// The measured material, if one is open, compared with the selected one in this form.
void drawMeasured(PanelContext&, const FitForm&);

/// The parameters of a section of the table, except for those named, which have widgets of their
/// own.
void drawSection(PanelContext&, const std::string& section,
                 std::initializer_list<std::string_view> without = {});

/// A command's help and key as tooltip.
void actionTooltip(Action);
/// A button for an action, with its tooltip. A `width` of 0 fits the text.
void actionButton(PanelContext&, Action, const char* text, float width = 0);
void actionRow(PanelContext&, float width,
               std::initializer_list<std::pair<Action, const char*>> buttons);

}  // namespace glint::viewer
