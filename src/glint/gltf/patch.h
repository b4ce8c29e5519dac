#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "glint/scene/scene.h"

namespace glint {

/// New numbers for one material of a file.
struct MaterialPatch {
  std::size_t index = 0;  ///< in the file; the number of its materials stands for the default one
  ShadingParameters values;
  unsigned textured = 0;     ///< bits of namespace textured: left to the material's textures
  unsigned switchedOff = 0;  ///< of namespace switchedOff
};

/// That of an edited material.
inline MaterialPatch patchOf(std::size_t index, const Material& edited) {
  return {index, edited.shading, edited.textured, edited.switchedOff};
}

/// The file's bytes with the numbers in `extras.glint` of the materials, and beside them the
/// nearest values that other viewers read: base colour and index of refraction, and where no
/// texture varies them metallic and roughness; only where those in the file mean something else.
///
/// The text is edited in place: everything else - unknown extensions, numbers as they are written,
/// the order of keys, white space, other chunks of a GLB - stays as it was. For the default
/// material a material is appended and given to the primitives that have none.
///
/// Throws InputError that begins with `name` if the bytes are not a glTF 2.0 file.
std::vector<std::byte> patchGltf(std::span<const std::byte> file,
                                 const std::vector<MaterialPatch>& patches,
                                 const std::string& name);

/// The names of other files that the file refers to (buffers and images), as its URIs have them, in
/// their order, each once: a copy of it elsewhere would not find those that are relative.
std::vector<std::string> referredFiles(std::span<const std::byte> file, const std::string& name);
bool refersToFiles(std::span<const std::byte> file, const std::string& name);

/// Whether the bytes are a GLB file, as their first four tell.
bool isGlb(std::span<const std::byte> file);

}  // namespace glint
