#pragma once

#include <string>
#include <vector>

namespace tinygltf {
class Model;
}

namespace glint::gltf {

/// Has tinygltf read a glTF text whose buffers' URIs are their numbers in `buffers`, which are
/// moved into the model. Returns what is wrong, or nothing. The one file that knows tinygltf's
/// versions (2.5 to 2.9).
std::string readGeometryModel(tinygltf::Model& model, const std::string& text,
                              std::vector<std::vector<unsigned char>>& buffers);

}  // namespace glint::gltf
