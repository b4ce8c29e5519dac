#pragma once

#include <vector>

#include "glint/gltf/document.h"
#include "glint/gltf/texture.h"
#include "glint/scene/scene.h"

namespace glint::gltf {

/// The file's materials in order, then glTF's default material. Factors are clamped to their range.
/// Where a texture supplies a parameter, its bit is set in Material::textured. `extras.glint`
/// overrides everything; entries that are not numbers are ignored and those out of range clamped,
/// with a warning.
std::vector<Material> readMaterials(Document& document, TextureReader& textures,
                                    Messages& messages);

}  // namespace glint::gltf
