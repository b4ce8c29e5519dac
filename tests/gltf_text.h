#pragma once

// glTF files that tests write to the temporary folder.

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "files.h"
#include "glint/scene/scene.h"

namespace glint::test {

/// Writes the mesh's triangles as FOLDER/NAME.gltf with FOLDER/NAME.bin; `change` may edit the
/// document. Returns the path.
inline std::string writeGltf(const std::string& name, const Mesh& mesh,
                             void (*change)(nlohmann::json&) = nullptr,
                             const std::string& folder = temporaryFolder()) {
  const std::size_t count = mesh.positions.size(), indices = mesh.indices.size();
  std::ofstream bin(folder + "/" + name + ".bin", std::ios::binary);
  const auto put = [&](const void* data, std::size_t size) {
    bin.write(static_cast<const char*>(data), std::streamsize(size));
  };
  put(mesh.positions.data(), 12 * count);
  put(mesh.normals.data(), 12 * count);
  put(mesh.indices.data(), 4 * indices);
  glm::vec3 low = mesh.positions.at(0), high = low;
  for (const glm::vec3& p : mesh.positions) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  nlohmann::json json = {
      {"asset", {{"version", "2.0"}}},
      {"scene", 0},
      {"scenes", {{{"nodes", {0}}}}},
      {"nodes", {{{"mesh", 0}}}},
      {"materials", {{{"name", "paint"}}}},
      {"meshes",
       {{{"primitives",
          {{{"attributes", {{"POSITION", 0}, {"NORMAL", 1}}}, {"indices", 2}, {"material", 0}}}}}}},
      {"buffers", {{{"uri", name + ".bin"}, {"byteLength", 24 * count + 4 * indices}}}},
      {"bufferViews",
       {{{"buffer", 0}, {"byteOffset", 0}, {"byteLength", 12 * count}},
        {{"buffer", 0}, {"byteOffset", 12 * count}, {"byteLength", 12 * count}},
        {{"buffer", 0}, {"byteOffset", 24 * count}, {"byteLength", 4 * indices}}}},
      {"accessors",
       {{{"bufferView", 0},
         {"componentType", 5126},
         {"count", count},
         {"type", "VEC3"},
         {"min", {low.x, low.y, low.z}},
         {"max", {high.x, high.y, high.z}}},
        {{"bufferView", 1}, {"componentType", 5126}, {"count", count}, {"type", "VEC3"}},
        {{"bufferView", 2}, {"componentType", 5125}, {"count", indices}, {"type", "SCALAR"}}}}};
  if (change) change(json);
  std::ofstream(folder + "/" + name + ".gltf") << json;
  return folder + "/" + name + ".gltf";
}

}  // namespace glint::test
