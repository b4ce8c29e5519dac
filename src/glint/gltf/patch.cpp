#include "glint/gltf/patch.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <variant>

#include "glint/image/error.h"
#include "glint/scene/look_text.h"
#include "glint/scene/material_parameters.h"
#include "glint/shading/pbr_conversion.h"

namespace glint {
namespace {

using Json = nlohmann::json;
using Step = std::variant<std::string, std::size_t>;
using Path = std::vector<Step>;

struct Span {
  std::size_t begin = 0, end = 0;
};

/// A valid JSON text that is edited by replacing values and inserting members.
class JsonText {
 public:
  explicit JsonText(std::string text) : text_(std::move(text)) {}
  const std::string& text() const { return text_; }

  std::optional<Span> find(const Path& path) const {
    Span at{text_.find('{'), 0};  // a byte order mark may stand before it
    at.end = skipValue(at.begin);
    for (const Step& step : path) {
      const auto next = std::holds_alternative<std::string>(step)
                            ? member(at, std::get<std::string>(step))
                            : item(at, std::get<std::size_t>(step));
      if (!next) return {};
      at = *next;
    }
    return at;
  }

  std::optional<Json> value(const Path& path) const {
    const auto at = find(path);
    if (!at) return {};
    return Json::parse(text_.begin() + std::ptrdiff_t(at->begin),
                       text_.begin() + std::ptrdiff_t(at->end));
  }

  /// Sets a member of objects that are made where they are missing. A value of another type where
  /// an object is needed is replaced.
  void set(const Path& path, const std::string& value) {
    if (const auto at = find(path)) {
      text_.replace(at->begin, at->end - at->begin, value);
      return;
    }
    const Path parent(path.begin(), path.end() - 1);
    const std::string entry = Json(std::get<std::string>(path.back())).dump() + ": " + value;
    const auto at = find(parent);
    if (!at || text_[at->begin] != '{')
      set(parent, "{" + entry + "}");
    else
      append(*at, entry);
  }

  /// Adds to an array, which must exist.
  void push(const Path& array, const std::string& value) { append(*find(array), value); }

 private:
  void append(Span container, const std::string& entry) {
    std::size_t last = container.end - 1;  // its closing bracket
    while (std::strchr(" \t\r\n", text_[last - 1])) --last;
    const bool empty = last == container.begin + 1;
    text_.insert(last, (empty ? "" : ", ") + entry);
  }

  std::size_t skipSpace(std::size_t i) const {
    while (i < text_.size() && std::strchr(" \t\r\n", text_[i]) && text_[i]) ++i;
    return i;
  }

  std::size_t skipString(std::size_t i) const {
    for (++i; text_[i] != '"'; ++i)
      if (text_[i] == '\\') ++i;
    return i + 1;
  }

  std::size_t skipValue(std::size_t i) const {
    std::size_t depth = 0;
    do {
      const char c = text_[i];
      if (c == '"') {
        i = skipString(i);
        continue;
      }
      if (c == '{' || c == '[') ++depth;
      if (c == '}' || c == ']') --depth;
      ++i;
      if (depth == 0 && !std::strchr("}]", c))  // a number or a word
        while (i < text_.size() && !std::strchr(",}] \t\r\n", text_[i])) ++i;
    } while (depth > 0);
    return i;
  }

  // The last member of that name, which is the one that parsers take.
  std::optional<Span> member(Span object, const std::string& key) const {
    if (text_[object.begin] != '{') return {};
    std::optional<Span> found;
    std::size_t i = skipSpace(object.begin + 1);
    while (text_[i] != '}') {
      const std::size_t keyEnd = skipString(i);
      const bool same = Json::parse(text_.begin() + std::ptrdiff_t(i),
                                    text_.begin() + std::ptrdiff_t(keyEnd)) == key;
      const std::size_t begin = skipSpace(skipSpace(keyEnd) + 1);
      const std::size_t end = skipValue(begin);
      if (same) found = Span{begin, end};
      i = skipSpace(end);
      if (text_[i] == ',') i = skipSpace(i + 1);
    }
    return found;
  }

  std::optional<Span> item(Span array, std::size_t index) const {
    if (text_[array.begin] != '[') return {};
    std::size_t i = skipSpace(array.begin + 1);
    while (text_[i] != ']') {
      const std::size_t end = skipValue(i);
      if (index-- == 0) return Span{i, end};
      i = skipSpace(end);
      if (text_[i] == ',') i = skipSpace(i + 1);
    }
    return {};
  }

  std::string text_;
};

struct File {
  std::string json;
  bool glb = false;
  std::size_t jsonEnd = 0;  ///< in the file; the bytes from there on are copied
};

std::uint32_t word(std::span<const std::byte> bytes, std::size_t at) {
  std::uint32_t v = 0;
  for (std::size_t i = 0; i < 4; ++i) v |= std::uint32_t(bytes[at + i]) << (8 * i);
  return v;
}

File takeApart(std::span<const std::byte> bytes, const std::string& name) {
  const auto refuse = [&]() -> File {
    throw InputError(name + ": not a glTF 2.0 file: nothing is written");
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
  // Padding of other writers, and a byte order mark, are no JSON.
  while (!file.json.empty() && file.json.back() == '\0') file.json.back() = ' ';
  if (!Json::accept(file.json) || !Json::parse(file.json).is_object()) return refuse();
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

std::string glintText(const ShadingParameters& values, unsigned textured) {
  std::string text = "{";
  for (const MaterialParameter& p : materialParameters())
    if ((p.textured & textured) == 0)
      text += "\"" + std::string(p.name) + "\": " + numberText(values.*p.value) + ", ";
  const glm::dvec3& c = values.color;
  return text + "\"color\": [" + numberText(c.r) + ", " + numberText(c.g) + ", " + numberText(c.b) +
         "]}";
}

double numberOr(const std::optional<Json>& value, double fallback) {
  return value && value->is_number() ? value->get<double>() : fallback;
}

// Ends the array or member that is named, so that others of the kind can follow.
Path below(const Path& path, std::initializer_list<const char*> keys) {
  Path longer = path;
  for (const char* key : keys) longer.emplace_back(std::string(key));
  return longer;
}

void setNearestPbr(JsonText& text, const Path& material, const ShadingParameters& values) {
  const Path pbr = below(material, {"pbrMetallicRoughness"});
  const Path base = below(pbr, {"baseColorFactor"});
  const Json old = text.value(base).value_or(Json::array({1.0, 1.0, 1.0, 1.0}));
  const auto component = [&](std::size_t i) {
    return old.is_array() && i < old.size() && old[i].is_number() ? old[i].get<double>() : 1.0;
  };
  const glm::dvec3 color = glm::clamp(values.color, 0.0, 1.0);
  if (color != glm::dvec3(component(0), component(1), component(2)))
    text.set(base, "[" + numberText(color.r) + ", " + numberText(color.g) + ", " +
                       numberText(color.b) + ", " + numberText(component(3)) + "]");
  if (!text.find(below(pbr, {"metallicRoughnessTexture"}))) {
    const Path metallic = below(pbr, {"metallicFactor"});
    if (numberOr(text.value(metallic), 1) != values.metalness)
      text.set(metallic, numberText(values.metalness));
    const Path roughness = below(pbr, {"roughnessFactor"});
    const double now = numberOr(text.value(roughness), 1);
    if (std::abs(exponentFromRoughness(now) - values.exponent) > 1e-9 * (1 + values.exponent))
      text.set(roughness, numberText(roughnessFromExponent(values.exponent)));
  }
  const Path ior = below(material, {"extensions", "KHR_materials_ior", "ior"});
  const double n = std::max(values.ior, 1.0);
  if (numberOr(text.value(ior), 1.5) != n) {
    text.set(ior, numberText(n));
    const Path used{std::string("extensionsUsed")};
    const Json names = text.value(used).value_or(Json());
    if (!names.is_array())
      text.set(used, "[\"KHR_materials_ior\"]");
    else if (std::find(names.begin(), names.end(), "KHR_materials_ior") == names.end())
      text.push(used, "\"KHR_materials_ior\"");
  }
}

// Appends a material that is glTF's default one and gives it to all primitives without any.
void makeDefaultExplicit(JsonText& text, std::size_t index) {
  const Path materials{std::string("materials")};
  if (text.find(materials))
    text.push(materials, "{}");
  else
    text.set(materials, "[{}]");
  const Json meshes = text.value({std::string("meshes")}).value_or(Json::array());
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    if (!meshes[m].contains("primitives")) continue;
    const Json& primitives = meshes[m]["primitives"];
    for (std::size_t p = 0; p < primitives.size(); ++p)
      if (!primitives[p].contains("material"))
        text.set({std::string("meshes"), m, std::string("primitives"), p, std::string("material")},
                 std::to_string(index));
  }
}

}  // namespace

std::vector<std::byte> patchGltf(std::span<const std::byte> bytes,
                                 const std::vector<MaterialPatch>& patches,
                                 const std::string& name) {
  const File file = takeApart(bytes, name);
  JsonText text(file.json);
  const Json materials = text.value({std::string("materials")}).value_or(Json::array());
  for (const MaterialPatch& patch : patches) {
    if (patch.index > materials.size())
      throw InputError(name + ": has changed and has no material " + std::to_string(patch.index) +
                       " any more: load it again");
    if (patch.index == materials.size()) makeDefaultExplicit(text, patch.index);
    const Path material{std::string("materials"), patch.index};
    text.set(below(material, {"extras", "glint"}), glintText(patch.values, patch.textured));
    setNearestPbr(text, material, patch.values);
  }
  return putTogether(file, text.text(), bytes);
}

std::vector<std::string> referredFiles(std::span<const std::byte> bytes, const std::string& name) {
  const Json json = Json::parse(takeApart(bytes, name).json);
  std::vector<std::string> files;
  for (const char* list : {"buffers", "images"})
    for (const Json& each : json.value(list, Json::array())) {
      if (!each.is_object() || !each.contains("uri") || !each["uri"].is_string()) continue;
      const auto& uri = each["uri"].get_ref<const std::string&>();
      if (uri.starts_with("data:") || std::find(files.begin(), files.end(), uri) != files.end())
        continue;
      files.push_back(uri);
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
