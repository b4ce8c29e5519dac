#pragma once

#include <string>

namespace tinygltf {
class Model;
}

namespace glint::gltf {

/// Has tinygltf read a glTF text that refers to no file. Returns what is wrong, or nothing. The one
/// file that knows tinygltf's versions (2.5 to 2.9).
std::string readGeometryModel(tinygltf::Model& model, const std::string& text);

}  // namespace glint::gltf
