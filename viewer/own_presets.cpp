#include "own_presets.h"

#include <algorithm>
#include <span>
#include <system_error>

#include "glint/options/outputs.h"
#include "xdg.h"

namespace glint::viewer {

namespace fs = std::filesystem;

fs::path ownPresetsFolder() {
  const fs::path config = configFolder();
  return config.empty() ? config : config / "materials";
}

std::vector<OwnPreset> ownPresets() {
  constexpr std::size_t most = 500;
  std::vector<OwnPreset> all;
  std::error_code error;
  fs::directory_iterator files(ownPresetsFolder(), error);
  for (; !error && files != fs::directory_iterator() && all.size() < most; files.increment(error))
    if (files->path().extension() == ".json")
      all.push_back({files->path().stem().string(), files->path()});
  std::ranges::sort(all, {}, &OwnPreset::name);
  return all;
}

fs::path ownPresetPath(const std::string& label) {
  std::string name = label.substr(0, 60);
  for (char& c : name)
    if (static_cast<unsigned char>(c) < ' ' || c == '/') c = '-';
  if (name.empty() || name[0] == '.') name.insert(0, "material");
  return ownPresetsFolder() / (name + ".json");
}

std::string ownPresetText(const OwnPreset& preset) {
  const std::vector<std::byte> bytes = readFile(preset.path.string(), Noted::no);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

void keepPreset(const fs::path& path, const std::string& text) { writeText(path.string(), text); }

}  // namespace glint::viewer
