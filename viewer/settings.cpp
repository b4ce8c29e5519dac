#include "settings.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <span>

#include "glint/image/file.h"
#include "glint/image/json_text.h"
#include "glint/options/outputs.h"
#include "xdg.h"

namespace glint::viewer {

using Json = nlohmann::ordered_json;

namespace {

constexpr const char* lobeViews[] = {"polar", "over-angle", "in-space"};

void number(const Json& json, const char* key, double low, double high, double& value) {
  const auto found = json.find(key);
  if (found == json.end() || !found->is_number()) return;
  const double v = found->get<double>();
  if (v >= low && v <= high) value = v;
}

void flag(const Json& json, const char* key, bool& value) {
  const auto found = json.find(key);
  if (found != json.end() && found->is_boolean()) value = found->get<bool>();
}

std::string textOf(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

std::filesystem::path settingsFile() {
  const std::filesystem::path folder = configFolder();
  return folder.empty() ? folder : folder / "viewer.json";
}

Settings readSettings(const std::string& text) {
  Settings s;
  const auto json = parsedJson<Json>(text);
  if (!json.is_object()) return s;
  glm::dvec2 window(s.window);
  if (const auto found = json.find("window");
      found != json.end() && found->is_array() && found->size() == 2) {
    const Json pair = {{"x", (*found)[0]}, {"y", (*found)[1]}};
    number(pair, "x", 480, 16384, window.x);
    number(pair, "y", 320, 16384, window.y);
  }
  s.window = glm::ivec2(window);
  flag(json, "panel", s.panel);
  number(json, "panel-width", 240, 4096, s.panelWidth);
  if (json.contains("scale")) number(json, "scale", 0.5, 4, s.scale);
  number(json, "incidence", 0, 89, s.incidence);
  if (const auto found = json.find("lobe"); found != json.end())
    for (std::size_t i = 0; i < std::size(lobeViews); ++i)
      if (*found == lobeViews[i]) s.lobe = LobeView(i);
  number(json, "amplification", 1, 256, s.amplification);
  return s;
}

std::string settingsText(const Settings& s) {
  Json json;
  json["glint-viewer"] = 1;
  json["window"] = {s.window.x, s.window.y};
  json["panel"] = s.panel;
  json["panel-width"] = s.panelWidth;
  if (s.scale > 0) json["scale"] = s.scale;
  json["incidence"] = s.incidence;
  json["lobe"] = lobeViews[std::size_t(s.lobe)];
  json["amplification"] = s.amplification;
  return json.dump(2) + "\n";
}

Settings loadSettings() {
  const std::filesystem::path path = settingsFile();
  return path.empty() ? Settings{} : readSettings(textOf(path));
}

void saveSettings(const Settings& settings) {
  const std::filesystem::path path = settingsFile();
  const std::string text = settingsText(settings);
  if (path.empty() || textOf(path) == text) return;
  std::error_code error;  // OutputFile reports a missing folder
  std::filesystem::create_directories(path.parent_path(), error);
  writeText(path.string(), text);
}

}  // namespace glint::viewer
