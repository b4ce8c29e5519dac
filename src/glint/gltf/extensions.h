#pragma once

#include <string>
#include <vector>

#include "glint/gltf/json.h"
#include "glint/scene/scene.h"

namespace glint::gltf {

/// What becomes of an extension: the one table behind the loader's refusals and warnings and
/// behind `glint info`.
FileExtension describeExtension(const std::string& name);

/// Those that a document uses or requires, each once, in its order.
std::vector<FileExtension> extensionsOf(Cursor root);

/// The skins and the meshes with morph targets of a checked document.
std::vector<FileSkin> skinsOf(Cursor root);
std::vector<FileMorph> morphsOf(Cursor root);

}  // namespace glint::gltf
