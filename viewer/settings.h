#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <string>

namespace glint::viewer {

/// How the plot of the lobe shows it: both of the first two in the plane of incidence.
enum class LobeView { polar, overAngle, inSpace };

/// What the window keeps from one start to the next: nothing that shapes a picture.
struct Settings {
  glm::ivec2 window{1372, 820};  ///< size at scale 1
  bool panel = true;
  double panelWidth = 372;  ///< at scale 1
  double scale = 0;         ///< of text and widgets; 0: the screen's
  double incidence = 30;    ///< of the lobe plot's light, degrees
  LobeView lobe = LobeView::polar;
  double amplification = 16;  ///< of differences
  bool operator==(const Settings&) const = default;
};

/// The file that settings stand in: viewer.json in configFolder(); empty without one.
std::filesystem::path settingsFile();

/// What the text says, with defaults for what it leaves open or says wrongly.
Settings readSettings(const std::string& json);
std::string settingsText(const Settings&);

/// Reads the settings file; defaults if there is none. Never throws: a window opens without it.
Settings loadSettings();

/// Writes it if it would change, making the folder. Throws InputError.
void saveSettings(const Settings&);

}  // namespace glint::viewer
