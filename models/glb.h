#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "mesh.h"

namespace glint::models {

/// The bytes of a binary glTF 2.0 file with one node, one mesh and one material (a glTF material
/// object; its name also names the mesh and the node). Indices take 16 bits where they fit.
std::string glb(const Mesh& mesh, const nlohmann::json& material);

}  // namespace glint::models
