#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <string>

namespace glint::viewer {

/// The view of the lobe plot; the first two show the plane of incidence.
enum class LobeView { polar, overAngle, inSpace };

/// Settings of the window that persist between runs; none affects a picture.
struct Settings {
  glm::ivec2 window{1372, 820};  ///< size at scale 1
  bool panel = true;
  double panelWidth = 372;  ///< at scale 1
  double scale = 0;         ///< of text and widgets; 0: from the screen
  double incidence = 30;    ///< of the lobe plot's light, degrees
  LobeView lobe = LobeView::polar;
  double amplification = 16;  ///< of differences
  bool operator==(const Settings&) const = default;
};

/// The settings file: viewer.json in configFolder(); empty without one.
std::filesystem::path settingsFile();

/// Parses settings, with defaults for missing or invalid values.
Settings readSettings(const std::string& json);
std::string settingsText(const Settings&);

/// Reads the settings file; defaults if there is none. Never throws, so that a window always opens.
Settings loadSettings();

/// Writes the settings if they have changed, creating the folder. Throws InputError.
void saveSettings(const Settings&);

}  // namespace glint::viewer
