// Arrays are converted to a glTF file, so that a single reader checks and repairs everything that
// is drawn, whatever its source.

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>

#include "glint/api/model_state.h"
#include "glint/options/parameters.h"
#include "glint/scene/look_text.h"
#include "glint/scene/material_parameters.h"

namespace glint {
namespace {

using GlbJson = nlohmann::json;

// glTF's constants, the same as OpenGL's.
constexpr int glFloat = 5126, glUnsignedInt = 5125;

class ArrayGlb {
 public:
  void add(const Arrays& part, std::size_t number);
  std::vector<std::byte> bytes();

 private:
  int view(const void* data, std::size_t size) {
    binary_.resize((binary_.size() + 3) / 4 * 4);
    document_["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", size}});
    const auto* const first = static_cast<const std::byte*>(data);
    binary_.insert(binary_.end(), first, first + size);
    return int(document_["bufferViews"].size()) - 1;
  }
  template <typename Value>
  int accessor(const std::vector<Value>& values, int component, const char* type) {
    document_["accessors"].push_back(
        {{"bufferView", view(values.data(), sizeof(Value) * values.size())},
         {"componentType", component},
         {"count", values.size()},
         {"type", type}});
    return int(document_["accessors"].size()) - 1;
  }
  template <typename Value>
  void attribute(GlbJson& attributes, const std::string& where, const char* name,
                 const std::vector<Value>& values, std::size_t count, const char* what,
                 const char* type) {
    if (values.empty()) return;
    if (values.size() != count)
      throw InputError(where + ": " + std::to_string(values.size()) + " " + what + " for " +
                       std::to_string(count) + " positions: give one for each, or none");
    attributes[name] = accessor(values, glFloat, type);
  }
  GlbJson material(const Arrays& part, const std::string& where);

  GlbJson document_, nodes_ = GlbJson::array();
  std::vector<std::byte> binary_;
};

GlbJson ArrayGlb::material(const Arrays& part, const std::string& where) {
  Look look;
  try {
    if (!part.material.empty()) parseMaterialEdit(look, part.material);
  } catch (const InputError& error) {
    throw InputError(where + ": " + error.what());
  }
  if (look.material.size() > 1 || (look.material.size() == 1 && !look.material.contains("")))
    throw InputError(where + ": material '" + part.material +
                     "' names a material: leave the name out");
  const MaterialEdit edit = look.material.empty() ? MaterialEdit{} : look.material.at("");
  if (edit.highlight || edit.fresnel)
    throw InputError(
        where + ": material '" + part.material +
        "': forms belong to the look: give them with the option \"material\" when drawing");
  const ShadingParameters plain;
  GlbJson extras = GlbJson::object();
  for (const MaterialParameter& each : materialParameters())
    extras[std::string(each.name)] = (edit.*each.edit).value_or(plain.*each.value);
  const glm::dvec3 color = edit.color.value_or(plain.color);
  extras["color"] = GlbJson::array({color.x, color.y, color.z});
  GlbJson result{{"extras", {{"glint", extras}}}, {"doubleSided", part.twoSided}};
  if (!part.name.empty()) result["name"] = part.name;
  if (std::ranges::any_of(part.colors, [](const auto& each) { return each[3] < 1; }))
    result["alphaMode"] = "BLEND";
  if (!part.texture.empty()) {
    const auto begins = [&](std::size_t at, const char* text) {
      return part.texture.size() >= at + std::strlen(text) &&
             std::memcmp(part.texture.data() + at, text, std::strlen(text)) == 0;
    };
    const char* const type = begins(1, "PNG")        ? "image/png"
                             : begins(0, "\xff\xd8") ? "image/jpeg"
                             : begins(8, "WEBP")     ? "image/webp"
                                                     : nullptr;
    if (!type) throw InputError(where + ": the texture is neither PNG nor JPEG nor WebP");
    document_["images"].push_back(
        {{"bufferView", view(part.texture.data(), part.texture.size())}, {"mimeType", type}});
    GlbJson texture{{"source", document_["images"].size() - 1}};
    if (type == std::string("image/webp")) {
      texture = {{"extensions", {{"EXT_texture_webp", texture}}}};
      document_["extensionsUsed"] = GlbJson::array({"EXT_texture_webp"});
    }
    document_["textures"].push_back(texture);
    result["pbrMetallicRoughness"] = {
        {"baseColorTexture", {{"index", document_["textures"].size() - 1}}}};
  }
  return result;
}

void ArrayGlb::add(const Arrays& part, std::size_t number) {
  const std::string where = "arrays[" + std::to_string(number) + "]";
  const std::size_t count = part.positions.size();
  if (count == 0) throw InputError(where + ": no positions: give some");
  const std::size_t corners = part.indices.empty() ? count : part.indices.size();
  if (corners % 3 != 0)
    throw InputError(where + ": " + std::to_string(corners) +
                     (part.indices.empty() ? " positions" : " indices") +
                     " are not a multiple of 3: give three for each triangle");
  for (const std::uint32_t index : part.indices)
    if (index >= count)
      throw InputError(where + ": index " + std::to_string(index) + " and " +
                       std::to_string(count) + " positions: give indices below their number");
  if (!part.texture.empty() && part.texcoords.empty())
    throw InputError(where + ": a texture needs texcoords: give one for each position");
  GlbJson attributes = GlbJson::object();
  attribute(attributes, where, "POSITION", part.positions, count, "positions", "VEC3");
  attribute(attributes, where, "NORMAL", part.normals, count, "normals", "VEC3");
  attribute(attributes, where, "COLOR_0", part.colors, count, "colors", "VEC4");
  attribute(attributes, where, "TEXCOORD_0", part.texcoords, count, "texcoords", "VEC2");
  GlbJson primitive{{"attributes", attributes}, {"material", number}};
  if (!part.indices.empty()) primitive["indices"] = accessor(part.indices, glUnsignedInt, "SCALAR");
  document_["materials"].push_back(material(part, where));
  document_["meshes"].push_back({{"primitives", GlbJson::array({primitive})}});
  document_["nodes"].push_back({{"mesh", number}, {"matrix", part.place}});
  nodes_.push_back(number);
}

std::vector<std::byte> ArrayGlb::bytes() {
  binary_.resize((binary_.size() + 3) / 4 * 4);
  if (binary_.size() > std::size_t(0xffffff00u))
    throw InputError("arrays: more than 4 GiB: split them into several models");
  document_["asset"]["version"] = "2.0";
  document_["scene"] = 0;
  document_["scenes"][0]["nodes"] = nodes_;
  document_["buffers"][0]["byteLength"] = binary_.size();
  std::string json = document_.dump();
  json.resize((json.size() + 3) / 4 * 4, ' ');
  std::vector<std::byte> file;
  const auto words = [&](std::initializer_list<std::size_t> values) {
    for (const std::size_t value : values)
      for (int shift = 0; shift < 32; shift += 8) file.push_back(std::byte(value >> shift & 255));
  };
  words({0x46546c67, 2, 12 + 8 + json.size() + 8 + binary_.size(), json.size(), 0x4e4f534a});
  const auto* const text = reinterpret_cast<const std::byte*>(json.data());
  file.insert(file.end(), text, text + json.size());
  words({binary_.size(), 0x004e4942});
  file.insert(file.end(), binary_.begin(), binary_.end());
  return file;
}

}  // namespace

std::vector<std::byte> glbOf(std::span<const Arrays> parts) {
  if (parts.empty()) throw InputError("arrays: there are none: give some to draw");
  ArrayGlb glb;
  for (std::size_t i = 0; i < parts.size(); ++i) glb.add(parts[i], i);
  return glb.bytes();
}

}  // namespace glint
