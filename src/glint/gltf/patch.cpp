#include "glint/gltf/patch.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "glint/gltf/json_edit.h"
#include "glint/image/error.h"
#include "glint/image/file.h"
#include "glint/image/json_text.h"
#include "glint/scene/look_text.h"
#include "glint/scene/material_parameters.h"
#include "glint/shading/pbr_conversion.h"

namespace glint {
namespace {

using gltf::JsonText;
using gltf::TextSpan;
using Json = nlohmann::json;
using Path = JsonText::Path;

struct File {
  std::string json;
  Json root;  ///< the parsed text
  bool glb = false;
  std::size_t jsonEnd = 0;  ///< in the file; the bytes from there on are copied
};

std::uint32_t word(std::span<const std::byte> bytes, std::size_t at) {
  std::uint32_t v = 0;
  for (std::size_t i = 0; i < 4; ++i) v |= std::uint32_t(bytes[at + i]) << (8 * i);
  return v;
}

File takeApart(std::span<const std::byte> bytes, const std::string& name) {
  const auto refuse = [&](const std::string& why = {}) -> File {
    throw InputError(printablePath(name) + ": not a glTF 2.0 file" +
                     (why.empty() ? why : ", " + why) + ": nothing is written");
  };
  File file;
  const std::string_view all(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  file.glb = all.starts_with("glTF");
  if (file.glb) {
    if (bytes.size() < 20 || word(bytes, 4) != 2 || word(bytes, 16) != 0x4E4F534A) return refuse();
    file.jsonEnd = 20 + std::size_t(word(bytes, 12));
    if (file.jsonEnd > bytes.size()) return refuse();
    file.json = all.substr(20, file.jsonEnd - 20);
  } else {
    file.jsonEnd = bytes.size();
    file.json = all;
  }
  // Other writers' padding and a byte order mark are not JSON.
  while (!file.json.empty() && file.json.back() == '\0') file.json.back() = ' ';
  std::string error;
  auto root = parseJsonText<Json>(file.json, error);
  if (!root || !root->is_object()) return refuse(error);
  file.root = std::move(*root);
  return file;
}

std::vector<std::byte> putTogether(const File& file, std::string json,
                                   std::span<const std::byte> bytes) {
  std::vector<std::byte> out;
  const auto add = [&](std::string_view text) {
    const auto* from = reinterpret_cast<const std::byte*>(text.data());
    out.insert(out.end(), from, from + text.size());
  };
  const auto addWord = [&](std::size_t v) {
    for (int i = 0; i < 4; ++i) out.push_back(std::byte(v >> (8 * i)));
  };
  if (!file.glb) {
    add(json);
    return out;
  }
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const std::size_t length = std::size_t(word(bytes, 8)) - (file.jsonEnd - 20) + json.size();
  add("glTF");
  addWord(2);
  addWord(length);
  addWord(json.size());
  add("JSON");
  add(json);
  out.insert(out.end(), bytes.begin() + std::ptrdiff_t(file.jsonEnd), bytes.end());
  return out;
}

std::string glintText(const MaterialPatch& patch) {
  std::string text = "{";
  for (const MaterialParameter& p : materialParameters())
    if ((p.textured & patch.textured) == 0)
      text += "\"" + std::string(p.name) + "\": " + numberText(patch.values.*p.value) + ", ";
  // A texture that gives m_s gives the share, too.
  if (patch.highlightShare && !(patch.textured & textured::specular))
    text += "\"" + std::string(shareKey) + "\": " + numberText(*patch.highlightShare) + ", ";
  for (const SwitchedTexture& t : switchedTextures())
    if (patch.switchedOff & t.bit) text += "\"" + std::string(t.name) + "\": false, ";
  const glm::dvec3& c = patch.values.color;
  return text + "\"color\": [" + numberText(c.r) + ", " + numberText(c.g) + ", " + numberText(c.b) +
         "]}";
}

double numberOr(const std::optional<Json>& value, double fallback) {
  return value && value->is_number() ? value->get<double>() : fallback;
}

/// Edits one material's text, an object. Returns true if it set KHR_materials_ior.
bool setNearestPbr(JsonText& text, const MaterialPatch& patch) {
  const ShadingParameters& values = patch.values;
  const std::string pbr = "pbrMetallicRoughness";
  const Path base{pbr, "baseColorFactor"};
  const Json old = text.value(base).value_or(Json::array({1.0, 1.0, 1.0, 1.0}));
  const auto component = [&](std::size_t i) {
    return old.is_array() && i < old.size() && old[i].is_number() ? old[i].get<double>() : 1.0;
  };
  const glm::dvec3 color = glm::clamp(values.color, 0.0, 1.0);
  if (color != glm::dvec3(component(0), component(1), component(2)))
    text.set(base, "[" + numberText(color.r) + ", " + numberText(color.g) + ", " +
                       numberText(color.b) + ", " + numberText(component(3)) + "]");
  // The m_s of a texture's texels is computed with these, in this program as well.
  if (patch.textured & textured::specular) return false;
  if (!text.find({pbr, "metallicRoughnessTexture"})) {
    const Path metallic{pbr, "metallicFactor"};
    if (numberOr(text.value(metallic), 1) != values.metalness)
      text.set(metallic, numberText(values.metalness));
    const Path roughness{pbr, "roughnessFactor"};
    const double now = numberOr(text.value(roughness), 1);
    if (std::abs(exponentFromRoughness(now) - values.exponent) > 1e-9 * (1 + values.exponent))
      text.set(roughness, numberText(roughnessFromExponent(values.exponent)));
  }
  const Path ior{"extensions", "KHR_materials_ior", "ior"};
  const double n = std::max(values.ior, 1.0);
  if (numberOr(text.value(ior), 1.5) == n) return false;
  text.set(ior, numberText(n));
  return true;
}

void useIor(JsonText& text) {
  const Path used{"extensionsUsed"};
  const Json names = text.value(used).value_or(Json());
  if (!names.is_array())
    text.set(used, "[\"KHR_materials_ior\"]");
  else if (std::find(names.begin(), names.end(), "KHR_materials_ior") == names.end())
    text.push(used, "\"KHR_materials_ior\"");
}

// Appends a copy of glTF's default material and assigns it to all primitives without a material.
void makeDefaultExplicit(JsonText& text, std::size_t index) {
  const Path materials{"materials"};
  if (text.find(materials))
    text.push(materials, "{}");
  else
    text.set(materials, "[{}]");
  std::vector<std::pair<TextSpan, std::string>> edits;
  if (const auto meshes = text.find({"meshes"}))
    for (const TextSpan mesh : text.items(*meshes)) {
      const auto primitives = text.member(mesh, "primitives");
      if (!primitives) continue;
      for (const TextSpan primitive : text.items(*primitives)) {
        if (text.member(primitive, "material")) continue;
        JsonText edited(text.text(primitive));
        edited.set({"material"}, std::to_string(index));
        edits.emplace_back(primitive, edited.text());
      }
    }
  text.replace(edits);
}

}  // namespace

std::vector<std::byte> patchGltf(std::span<const std::byte> bytes,
                                 const std::vector<MaterialPatch>& patches,
                                 const std::string& name) {
  const File file = takeApart(bytes, name);
  JsonText text(file.json);
  const auto listed = file.root.find("materials");
  const std::size_t count = listed == file.root.end() ? 0 : listed->size();
  std::map<std::size_t, const MaterialPatch*> byIndex;
  for (const MaterialPatch& patch : patches) {
    if (patch.index > count)
      throw InputError(printablePath(name) + ": has changed and no longer has the material " +
                       std::to_string(patch.index) + ": load it again");
    byIndex[patch.index] = &patch;
  }
  if (byIndex.contains(count)) makeDefaultExplicit(text, count);
  std::vector<std::pair<TextSpan, std::string>> edits;
  bool usesIor = false;
  if (const auto array = text.find({"materials"}); array && !byIndex.empty()) {
    const std::vector<TextSpan> materials = text.items(*array);
    for (const auto& [index, patch] : byIndex) {
      JsonText material(text.text(materials.at(index)));
      material.set({"extras", "glint"}, glintText(*patch));
      usesIor = setNearestPbr(material, *patch) || usesIor;
      edits.emplace_back(materials[index], material.text());
    }
  }
  text.replace(edits);
  if (usesIor) useIor(text);
  return putTogether(file, text.text(), bytes);
}

std::vector<std::string> referredFiles(std::span<const std::byte> bytes, const std::string& name) {
  const File file = takeApart(bytes, name);
  std::vector<std::string> files;
  for (const char* list : {"buffers", "images"}) {
    const auto found = file.root.find(list);
    if (found == file.root.end()) continue;
    for (const Json& each : *found) {
      if (!each.is_object() || !each.contains("uri") || !each["uri"].is_string()) continue;
      const auto& uri = each["uri"].get_ref<const std::string&>();
      if (uri.starts_with("data:") || std::find(files.begin(), files.end(), uri) != files.end())
        continue;
      files.push_back(uri);
    }
  }
  return files;
}

bool refersToFiles(std::span<const std::byte> bytes, const std::string& name) {
  return !referredFiles(bytes, name).empty();
}

bool isGlb(std::span<const std::byte> bytes) {
  return bytes.size() >= 4 && std::memcmp(bytes.data(), "glTF", 4) == 0;
}

}  // namespace glint
