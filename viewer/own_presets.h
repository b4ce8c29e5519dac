#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace glint::viewer {

/// A material that the user keeps: a file NAME.json with the text of materialText().
struct OwnPreset {
  std::string name;
  std::filesystem::path path;
};

/// configFolder()/materials; empty without one.
std::filesystem::path ownPresetsFolder();

/// Those in the folder, by name, at most 500.
std::vector<OwnPreset> ownPresets();

/// Where a material of this label (any text) may be kept.
std::filesystem::path ownPresetPath(const std::string& label);

/// Throw InputError.
std::string ownPresetText(const OwnPreset&);
void keepPreset(const std::filesystem::path&, const std::string& text);

}  // namespace glint::viewer
