#include "glint/gltf/extensions.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <utility>

#include "glint/gltf/compression.h"
#include "glint/image/texture.h"

namespace glint::gltf {
namespace {

using Use = FileExtension::Use;

struct Entry {
  const char* name;
  Use use;
  const char* note;
  const char* option = nullptr;  ///< build option, if the extension is optional
};

constexpr std::array table = {
    Entry{"KHR_materials_unlit", Use::read, ""},
    Entry{"KHR_materials_ior", Use::read, ""},
    Entry{"KHR_materials_emissive_strength", Use::read, ""},
    Entry{"KHR_materials_specular", Use::approximated, "its strength; not its colour"},
    Entry{"KHR_materials_transmission", Use::read, "by the program environment"},
    Entry{"KHR_materials_pbrSpecularGlossiness", Use::approximated,
          "converted to the notes' parameters, texel by texel"},
    Entry{"KHR_materials_variants", Use::read, "by --variant"},
    Entry{"EXT_mesh_gpu_instancing", Use::read, "instance transforms; no custom attributes"},
    Entry{"KHR_texture_basisu", Use::approximated, "not read; the other image of a texture is"},
    Entry{"KHR_mesh_quantization", Use::read, ""},
    Entry{"KHR_texture_transform", Use::read, ""},
    Entry{"KHR_lights_punctual", Use::read, "with an exposure of glint's own"},
    Entry{"KHR_node_visibility", Use::read, "not animated"},
    Entry{"EXT_meshopt_compression", Use::read, "", "GLINT_MESHOPT"},
    Entry{"KHR_draco_mesh_compression", Use::read, "", "GLINT_DRACO"},
    Entry{"EXT_texture_webp", Use::read, "", "GLINT_WEBP"},
};

/// Extensions without effect on a picture: metadata, and behaviour outside of pictures.
constexpr std::array unseen = {
    "KHR_xmp",
    "KHR_xmp_json_ld",
    "KHR_interactivity",
    "KHR_node_hoverability",
    "KHR_node_selectability",
    "KHR_audio_emitter",
    "KHR_implicit_shapes",
    "KHR_physics_rigid_bodies",
    "EXT_feature_metadata",
    "EXT_instance_features",
    "EXT_mesh_features",
    "EXT_structural_metadata",
    "AGI_articulations",
    "AGI_stk_metadata",
    "FB_ngon_encoding",
    "GODOT_single_root",
    "MSFT_lod",
    "MSFT_packing_normalRoughnessMetallic",
    "MSFT_packing_occlusionRoughnessMetallic",
    "MSFT_audio_emitter",
    "OMI_collider",
    "OMI_physics_body",
    "OMI_physics_shape",
    "VRM",
    "VRMC_vrm",
    "VRMC_springBone",
    "VRMC_node_constraint",
};

/// Unsupported extensions of materials, and the factor that is 0 if they have no visible effect.
constexpr std::pair<const char*, const char*> factors[] = {
    {"KHR_materials_anisotropy", "anisotropyStrength"},
    {"KHR_materials_clearcoat", "clearcoatFactor"},
    {"KHR_materials_diffuse_transmission", "diffuseTransmissionFactor"},
    {"KHR_materials_dispersion", "dispersion"},
    {"KHR_materials_iridescence", "iridescenceFactor"},
    {"KHR_materials_sheen", "sheenColorFactor"},
    {"KHR_materials_volume", "thicknessFactor"},
};

bool isAbove0(const Json& value) {
  const auto above = [](const Json& v) { return v.is_number() && v.get<double>() > 0; };
  return above(value) || (value.is_array() && std::ranges::any_of(value, above));
}

/// Whether an unsupported extension has a visible effect in some material.
bool shows(Cursor root, const std::string& name) {
  const auto found =
      std::ranges::find_if(factors, [&](const auto& each) { return name == each.first; });
  if (found == std::end(factors)) return true;
  for (const Cursor material : root.member("materials")) {
    const Cursor factor = material.member("extensions").member(name.c_str()).member(found->second);
    if (factor.exists() && isAbove0(factor.json())) return true;
  }
  return false;
}

bool isInBuild(const Entry& entry) {
  if (!entry.option) return true;
  return readsCompression(entry.name) ||
         (entry.name == std::string_view("EXT_texture_webp") && canDecodeWebp());
}

}  // namespace

FileExtension describeExtension(const std::string& name) {
  FileExtension result{name, Use::ignored, "not supported by this version"};
  const auto found = std::ranges::find(table, name, &Entry::name);
  if (std::ranges::find(unseen, name) != unseen.end())
    return {name, Use::unseen, "no effect on a picture"};
  if (found == table.end()) return result;
  if (!isInBuild(*found)) {
    result.note = std::string("left out of this build (") + found->option + " is off)";
    return result;
  }
  result.use = found->use;
  result.note = found->note;
  return result;
}

std::vector<FileExtension> extensionsOf(Cursor root) {
  std::vector<FileExtension> result;
  std::map<std::string, std::size_t> places;
  for (const char* list : {"extensionsUsed", "extensionsRequired"}) {
    const bool required = list == std::string_view("extensionsRequired");
    for (const Cursor each : root.member(list)) {
      const std::string name = printable(each.text(), 80);
      const auto [place, isNew] = places.try_emplace(name, result.size());
      if (isNew) result.push_back(describeExtension(name));
      result[place->second].required |= required;
    }
  }
  // A loader must not ignore an unknown required extension, whether or not it has a visible effect.
  for (FileExtension& each : result)
    if (each.use == Use::ignored && !each.required && !shows(root, each.name))
      each = {each.name, Use::unseen, "no material uses it visibly"};
  return result;
}

std::vector<FileSkin> skinsOf(Cursor root) {
  std::vector<FileSkin> result;
  for (const Cursor from : root.member("skins")) {
    FileSkin& skin = result.emplace_back(FileSkin{printable(from.name(), 80), {}});
    for (const Cursor joint : from.member("joints")) {
      const auto node = static_cast<std::size_t>(joint.integer(0, 0, INT32_MAX));
      skin.joints.push_back(printable(root.member("nodes").item(node).name(), 80));
    }
  }
  return result;
}

std::vector<FileMorph> morphsOf(Cursor root) {
  std::vector<FileMorph> result;
  for (const Cursor mesh : root.member("meshes")) {
    std::size_t count = 0;
    for (const Cursor primitive : mesh.member("primitives"))
      count = std::max(count, primitive.member("targets").size());
    if (count == 0) continue;
    FileMorph morph{printable(mesh.name(), 80), std::vector<std::string>(count)};
    // By convention names are in "extras", whose structure is not guaranteed.
    const Json& json = mesh.json();
    const auto extras = json.find("extras");
    if (extras != json.end() && extras->is_object()) {
      const auto names = extras->find("targetNames");
      for (std::size_t t = 0; names != extras->end() && names->is_array() && t < count; ++t) {
        if (t < names->size() && (*names)[t].is_string()) {
          morph.targets[t] = printable((*names)[t].get<std::string>(), 80);
        }
      }
    }
    result.push_back(std::move(morph));
  }
  return result;
}

}  // namespace glint::gltf
