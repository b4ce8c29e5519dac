#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "glint/scene/scene.h"

namespace glint {

/// New numbers for one material of a file.
struct MaterialPatch {
  std::size_t index = 0;  ///< in the file; the number of materials means the default one
  ShadingParameters values;
  unsigned textured = 0;     ///< bits of namespace textured: left to the material's textures
  unsigned switchedOff = 0;  ///< bits of namespace switchedOff
  std::optional<double> highlightShare = {};  ///< as in Material
};

/// The patch for an edited material (withEdits()).
inline MaterialPatch patchOf(std::size_t index, const Material& edited) {
  return {index, edited.shading, edited.textured, edited.switchedOff, edited.highlightShare};
}

/// The file's bytes with the numbers in the materials' `extras.glint` and, next to them, the
/// nearest values for other viewers: base colour, index of refraction and, unless a texture varies
/// them, metallic and roughness. Those are only changed if the values in the file mean something
/// else. The last three stay if m_s is left to textures, since it is computed from them.
///
/// The text is edited in place: everything else - unknown extensions, the notation of numbers, key
/// order, white space, other chunks of a GLB - is preserved. For the default material a material is
/// appended and assigned to the primitives that have none.
///
/// Throws InputError starting with `name` if the bytes are not a glTF 2.0 file.
std::vector<std::byte> patchGltf(std::span<const std::byte> file,
                                 const std::vector<MaterialPatch>& patches,
                                 const std::string& name);

/// The files that the file refers to (buffers and images), as named in its URIs, in order, each
/// once: a copy of the file elsewhere would not find those with relative names.
std::vector<std::string> referredFiles(std::span<const std::byte> file, const std::string& name);
bool refersToFiles(std::span<const std::byte> file, const std::string& name);

/// Whether the bytes are a GLB file, judging by the first four.
bool isGlb(std::span<const std::byte> file);

}  // namespace glint
