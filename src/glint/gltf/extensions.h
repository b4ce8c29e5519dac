#pragma once

#include <string>
#include <vector>

#include "glint/gltf/json.h"
#include "glint/scene/scene.h"

namespace glint::gltf {

/// How an extension is handled: the single table behind the loader's errors and warnings and
/// `glint info`.
FileExtension describeExtension(const std::string& name);

/// The extensions that a document uses or requires, each once, in document order.
std::vector<FileExtension> extensionsOf(Cursor root);

/// The skins and the meshes with morph targets of a checked document.
std::vector<FileSkin> skinsOf(Cursor root);
std::vector<FileMorph> morphsOf(Cursor root);

}  // namespace glint::gltf
