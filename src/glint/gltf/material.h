#pragma once

#include <vector>

#include "glint/gltf/document.h"
#include "glint/gltf/texture.h"
#include "glint/scene/scene.h"

namespace glint::gltf {

/// The file's materials in their order, then glTF's default material. Factors out of their range
/// are brought into it. Where a metallicRoughnessTexture exists, which no program reads, metallic
/// and roughness factors are halved: 0.5 is taken for the texture's mean. `extras.glint` wins over
/// all; what of it is not a number is ignored and what is out of range is clamped, with a warning.
std::vector<Material> readMaterials(Document& document, TextureReader& textures,
                                    Messages& messages);

}  // namespace glint::gltf
