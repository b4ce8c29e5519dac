#include "glint/gltf/extensions.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>

#include "glint/gltf/compression.h"
#include "glint/image/texture.h"

namespace glint::gltf {
namespace {

using Use = FileExtension::Use;

struct Entry {
  const char* name;
  Use use;
  const char* note;
  const char* option = nullptr;  ///< of the build, where it may lack the extension
};

constexpr std::array table = {
    Entry{"KHR_materials_unlit", Use::read, ""},
    Entry{"KHR_materials_ior", Use::read, ""},
    Entry{"KHR_materials_emissive_strength", Use::read, ""},
    Entry{"KHR_materials_specular", Use::approximated, "the factor; no texture, no colour"},
    Entry{"KHR_materials_transmission", Use::approximated,
          "the factor, by the program environment; no texture"},
    Entry{"KHR_mesh_quantization", Use::read, ""},
    Entry{"KHR_texture_transform", Use::read, ""},
    Entry{"KHR_lights_punctual", Use::read, "with an exposure of glint's own"},
    Entry{"KHR_node_visibility", Use::read, "not animated"},
    Entry{"EXT_meshopt_compression", Use::read, "", "GLINT_MESHOPT"},
    Entry{"KHR_draco_mesh_compression", Use::read, "", "GLINT_DRACO"},
    Entry{"EXT_texture_webp", Use::read, "", "GLINT_WEBP"},
};

bool isInBuild(const Entry& entry) {
  if (!entry.option) return true;
  return readsCompression(entry.name) ||
         (entry.name == std::string_view("EXT_texture_webp") && canDecodeWebp());
}

}  // namespace

FileExtension describeExtension(const std::string& name) {
  FileExtension result{name, Use::ignored, "not supported by this version"};
  const auto found = std::ranges::find(table, name, &Entry::name);
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
    const Cursor names = root.member(list);
    for (std::size_t i = 0; i < names.size(); ++i) {
      const std::string name = printable(names.item(i).text(), 80);
      const auto [place, isNew] = places.try_emplace(name, result.size());
      if (isNew) result.push_back(describeExtension(name));
      result[place->second].required |= required;
    }
  }
  return result;
}

std::vector<FileSkin> skinsOf(Cursor root) {
  std::vector<FileSkin> result;
  const Cursor skins = root.member("skins");
  for (std::size_t i = 0; i < skins.size(); ++i) {
    const Cursor joints = skins.item(i).member("joints");
    FileSkin skin{printable(skins.item(i).name(), 80), {}};
    for (std::size_t k = 0; k < joints.size(); ++k) {
      const auto node = static_cast<std::size_t>(joints.item(k).integer(0, 0, INT32_MAX));
      skin.joints.push_back(printable(root.member("nodes").item(node).name(), 80));
    }
    result.push_back(std::move(skin));
  }
  return result;
}

std::vector<FileMorph> morphsOf(Cursor root) {
  std::vector<FileMorph> result;
  const Cursor meshes = root.member("meshes");
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const Cursor mesh = meshes.item(i);
    const Cursor primitives = mesh.member("primitives");
    std::size_t count = 0;
    for (std::size_t k = 0; k < primitives.size(); ++k) {
      count = std::max(count, primitives.item(k).member("targets").size());
    }
    if (count == 0) continue;
    FileMorph morph{printable(mesh.name(), 80), std::vector<std::string>(count)};
    // Names stand by custom in "extras", whose form nobody promises.
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
