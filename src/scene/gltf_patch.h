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
};

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

/// Whether the file refers to other files by names relative to its folder, so that a copy
/// elsewhere would not find them.
bool refersToFiles(std::span<const std::byte> file, const std::string& name);

}  // namespace glint
