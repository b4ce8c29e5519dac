#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace glint::viewer {

/// A material preset of the user: a file NAME.json with the text of materialText().
struct OwnPreset {
  std::string name;
  std::filesystem::path path;
};

/// configFolder()/materials; empty if there is no config folder.
std::filesystem::path ownPresetsFolder();

/// The presets in the folder, by name, at most 500.
std::vector<OwnPreset> ownPresets();

/// The path for saving a material with this label (any text).
std::filesystem::path ownPresetPath(const std::string& label);

/// Throw InputError.
std::string ownPresetText(const OwnPreset&);
void keepPreset(const std::filesystem::path&, const std::string& text);

}  // namespace glint::viewer
