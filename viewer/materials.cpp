#include "materials.h"

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "glint/image/error.h"
#include "glint/image/json_text.h"
#include "glint/image/printable.h"
#include "glint/scene/camera.h"
#include "glint/scene/look_text.h"
#include "glint/scene/material_key.h"

namespace glint::viewer {

using Json = nlohmann::ordered_json;

std::vector<int> drawnMaterials(const Scene& scene) {
  std::set<int> used;
  for (const Instance& i : scene.instances) used.insert(scene.meshes[std::size_t(i.mesh)].material);
  return {used.begin(), used.end()};
}

std::string materialKey(const Scene& scene, int index) {
  return index < 0 ? "" : materialKey(scene.materials[std::size_t(index)]);
}

std::string materialLabel(const Scene& scene, int index) {
  const std::string key = materialKey(scene, index);
  return key.empty() ? "all materials" : printable(key);
}

Material effectiveMaterial(const Scene& scene, const Look& look, int index) {
  if (index >= 0) return editedMaterial(scene.materials[std::size_t(index)], look);
  const std::vector<int> drawn = drawnMaterials(scene);
  Material first = scene.materials[std::size_t(drawn.empty() ? 0 : drawn.front())];
  first.name.clear();  // so that only the edits of all materials apply
  first.index = -1;
  return editedMaterial(first, look);
}

ShadingParameters effectiveParameters(const Scene& scene, const Look& look, int index) {
  return effectiveMaterial(scene, look, index).shading;
}

ValueSpread spreadOf(const Scene& scene, const Look& look, const MaterialParameter& p) {
  ValueSpread spread{std::numeric_limits<double>::infinity(),
                     -std::numeric_limits<double>::infinity()};
  for (const int index : drawnMaterials(scene)) {
    const double value = effectiveParameters(scene, look, index).*p.value;
    spread.least = std::min(spread.least, value);
    spread.most = std::max(spread.most, value);
  }
  return spread;
}

bool haveOneColor(const Scene& scene, const Look& look) {
  std::optional<glm::dvec3> first;
  for (const int index : drawnMaterials(scene)) {
    const glm::dvec3 color = effectiveParameters(scene, look, index).color;
    if (first && *first != color) return false;
    first = color;
  }
  return true;
}

void setParameters(Look& look, const std::string& key, const ShadingParameters& values) {
  if (key.empty()) look.material.clear();  // edits of single materials would take precedence
  MaterialEdit& edit = look.material[key];
  for (const MaterialParameter& p : materialParameters()) edit.*p.edit = values.*p.value;
  edit.color = values.color;
}

namespace {

void dropEmpty(Look& look) {
  std::erase_if(look.material, [](const auto& each) { return each.second == MaterialEdit{}; });
}

}  // namespace

std::string dropMissing(Look& look, const Scene& scene) {
  std::string missing;
  const auto add = [&](const std::string& what) {
    missing += (missing.empty() ? "" : ", ") + what;
  };
  gatherMaterialEdits(look, scene);
  std::set<std::string> known{""};
  for (const Material& m : scene.materials)
    for (std::string& key : materialKeys(m)) known.insert(std::move(key));
  std::erase_if(look.material, [&](const auto& each) {
    const bool there = known.contains(each.first);
    if (!there) add("material '" + each.first + "'");
    return !there;
  });
  if (look.cameraIndex && !std::ranges::binary_search(usableCameras(scene), *look.cameraIndex)) {
    add("camera " + std::to_string(*look.cameraIndex));
    look.cameraIndex.reset();
  }
  return missing;
}

void resetParameter(Look& look, const std::string& key, const MaterialParameter& p) {
  for (auto& [name, edit] : look.material)
    if (key.empty() || name == key) (edit.*p.edit).reset();
  dropEmpty(look);
}

void resetColor(Look& look, const std::string& key) {
  for (auto& [name, edit] : look.material)
    if (key.empty() || name == key) edit.color.reset();
  dropEmpty(look);
}

void resetTexture(Look& look, const std::string& key, const SwitchedTexture& texture) {
  for (auto& [name, edit] : look.material)
    if (key.empty() || name == key) (edit.*texture.edit).reset();
  dropEmpty(look);
}

void resetMaterial(Look& look, const std::string& key) {
  if (key.empty())
    look.material.clear();
  else
    look.material.erase(key);
}

std::string materialText(const ShadingParameters& values) {
  Json json = Json::object();
  for (const MaterialParameter& p : materialParameters())
    json[std::string(p.name)] = values.*p.value;
  json["color"] = {values.color.r, values.color.g, values.color.b};
  return Json{{"glint", json}}.dump();
}

void pasteMaterial(Look& look, const std::string& key, const std::string& text) {
  Look changed = look;
  std::string error;
  const std::optional<Json> parsed = parseJsonText<Json>(text, error);
  if (!parsed) {
    if (text.find('=') == std::string::npos || text.find('\n') != std::string::npos)
      throw InputError(
          "this is not a material: paste one, or text such as {\"exponent\": 40} or "
          "exponent=40,color=#c04020");
    parseMaterialEdit(changed, key.empty() ? text : key + ":" + text);
  } else {
    const Json& json = *parsed;
    const Json* from = json.is_object() && json.contains("extras") ? &json["extras"] : &json;
    if (from->is_object() && from->contains("glint")) from = &(*from)["glint"];
    if (!from->is_object() || from->empty())
      throw InputError("this JSON has no material parameters");
    for (const auto& [name, value] : from->items()) {
      std::string number;
      if (value.is_array() && value.size() == 3 && value[0].is_number() && value[1].is_number() &&
          value[2].is_number())
        for (const Json& each : value)
          number += (number.empty() ? "" : ",") + numberText(each.get<double>());
      else if (value.is_string())
        number = value.get<std::string>();
      else if (value.is_boolean())
        number = value.get<bool>() ? "on" : "off";
      else if (value.is_number())
        number = numberText(value.get<double>());
      setMaterialEdit(changed, key, name, number);
    }
  }
  look = std::move(changed);
}

}  // namespace glint::viewer
