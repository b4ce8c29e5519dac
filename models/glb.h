#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "mesh.h"

namespace glint::models {

using nlohmann::json;

/// The constants of glTF, which are those of OpenGL.
enum Gl {
  unsignedByte = 5121,
  unsignedShort = 5123,
  unsignedInt = 5125,
  float32 = 5126,
  array = 34962,
  elements = 34963
};

/// A binary glTF 2.0 file under construction: the document, and the buffer with all accessors, each
/// in a view of its own. The functions that add something return its index.
class GlbBuilder {
 public:
  json document;  ///< materials, skins, animations and extensions are written here directly

  /// Floats, with the bounds that glTF requires for positions.
  template <int Size>
  int addVertices(const std::vector<glm::vec<Size, float>>& values);
  int addBytes(const std::vector<glm::u8vec4>& values);
  int addMatrices(const std::vector<glm::mat4>& values);
  int addKeys(const std::vector<float>& values);      ///< times, or weights
  int addKeys(const std::vector<glm::vec4>& values);  ///< rotations
  /// 16 bits wide if that is enough for `vertices`.
  int addIndices(const std::vector<std::uint32_t>& indices, std::size_t vertices);

  /// Adds the vertices and indices of a mesh; returns its glTF primitive.
  json primitive(const Mesh& mesh, int material);
  int addMesh(const std::string& name, const json& primitive);
  int addNode(const json& node);

  /// The complete file; `roots` are the root nodes of its scene.
  std::string bytes(const std::vector<int>& roots);

 private:
  int addValues(const void* data, std::size_t bytes, std::size_t count, json view, json accessor);

  std::string buffer_;
};

template <int Size>
int GlbBuilder::addVertices(const std::vector<glm::vec<Size, float>>& values) {
  using Value = glm::vec<Size, float>;
  Value least(std::numeric_limits<float>::infinity());
  Value most(-std::numeric_limits<float>::infinity());
  for (const Value& value : values) {
    least = glm::min(least, value);
    most = glm::max(most, value);
  }
  json minimum, maximum;
  for (int i = 0; i < Size; ++i) {
    minimum.push_back(least[i]);
    maximum.push_back(most[i]);
  }
  constexpr const char* types[] = {"VEC2", "VEC3", "VEC4"};
  return addValues(values.data(), values.size() * sizeof(Value), values.size(),
                   {{"target", Gl::array}, {"byteStride", sizeof(Value)}},
                   {{"componentType", Gl::float32},
                    {"type", types[Size - 2]},
                    {"min", minimum},
                    {"max", maximum}});
}

/// The bytes of a file with one node, one mesh and one material. `material` is a glTF material
/// object, whose name is also that of the mesh and the node.
std::string glb(const Mesh& mesh, const json& material);

}  // namespace glint::models
