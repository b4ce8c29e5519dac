#pragma once

#include <string>

namespace tinygltf {
class Model;
}

namespace glint::gltf {

/// Has tinygltf read a glTF text that refers to no files. Returns the error, or an empty string.
/// Only this file depends on tinygltf's version (2.5 to 2.9). It takes no parsed document: what was
/// parsed is written once more for it, without all that it need not read.
std::string readGeometryModel(tinygltf::Model& model, const std::string& text);

}  // namespace glint::gltf
