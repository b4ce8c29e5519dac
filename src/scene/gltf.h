#pragma once

#include <filesystem>

#include "glint/scene/scene.h"

namespace glint {

/// Reads a glTF 2.0 model, `.gltf` or `.glb` (told apart by content, not by name), with all it
/// refers to: buffers and the images that a colour or emission texture shows, not decoded.
///
/// Takes the static core: every accessor layout, primitive mode and texture setting, cameras, morph
/// targets at their default weights and skins in the pose the file stands in (both baked into
/// meshes of their own), and KHR_materials_unlit, _ior, _specular, _transmission,
/// _emissive_strength and KHR_mesh_quantization. Animations are not read.
///
/// The result satisfies what scene.h promises: indices in range, values finite, normals of unit
/// length. What is wrong but harmless is mended and told in Scene::warnings.
///
/// Throws InputError, one line "PATH: what is wrong: what to do", for a file that cannot be read,
/// is not glTF 2.0, contradicts itself or requires an extension not supported.
Scene loadGltf(const std::filesystem::path& path);

}  // namespace glint
