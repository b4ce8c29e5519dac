#include "glb.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>

namespace glint::models {
namespace {

using nlohmann::json;

static_assert(std::endian::native == std::endian::little, "glTF is little-endian");

/// The constants of glTF, which are those of OpenGL.
enum Gl {
  unsignedShort = 5123,
  unsignedInt = 5125,
  float32 = 5126,
  array = 34962,
  elements = 34963
};

template <typename T>
void append(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// The document and its buffer while they grow. Every accessor has a view of its own.
class Builder {
 public:
  json document;
  std::string buffer;

  /// One accessor over all of `values`; its index. Floats get the bounds that glTF asks for.
  template <int Size>
  int addVertices(const std::vector<glm::vec<Size, float>>& values) {
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
    const json view = {{"target", Gl::array}, {"byteStride", sizeof(Value)}};
    return addAccessor(values, view,
                       {{"componentType", Gl::float32},
                        {"type", Size == 2 ? "VEC2" : "VEC3"},
                        {"min", minimum},
                        {"max", maximum}});
  }

  /// `Index` is the type stored.
  template <typename Index>
  int addIndices(const std::vector<std::uint32_t>& indices) {
    const std::vector<Index> stored(indices.begin(), indices.end());
    const int componentType = sizeof(Index) == 2 ? Gl::unsignedShort : Gl::unsignedInt;
    return addAccessor(stored, {{"target", Gl::elements}},
                       {{"componentType", componentType}, {"type", "SCALAR"}});
  }

 private:
  template <typename T>
  int addAccessor(const std::vector<T>& values, json view, json accessor) {
    view["buffer"] = 0;
    view["byteOffset"] = buffer.size();
    view["byteLength"] = values.size() * sizeof(T);
    accessor["bufferView"] = document["bufferViews"].size();
    accessor["count"] = values.size();
    document["bufferViews"].push_back(view);
    document["accessors"].push_back(accessor);
    for (const T& value : values) {
      append(buffer, value);
    }
    buffer.resize((buffer.size() + 3) / 4 * 4, '\0');
    return static_cast<int>(document["accessors"].size()) - 1;
  }
};

/// A chunk of a GLB file, filled up to a multiple of four bytes.
void appendChunk(std::string& file, const char (&type)[5], std::string data, char filler) {
  data.resize((data.size() + 3) / 4 * 4, filler);
  append(file, static_cast<std::uint32_t>(data.size()));
  file.append(type, 4);
  file += data;
}

}  // namespace

std::string glb(const Mesh& mesh, const json& material) {
  Builder builder;
  json attributes;
  attributes["POSITION"] = builder.addVertices<3>(mesh.positions);
  attributes["NORMAL"] =
      mesh.normals.empty() ? attributes["POSITION"] : json(builder.addVertices<3>(mesh.normals));
  if (!mesh.texcoords.empty()) {
    attributes["TEXCOORD_0"] = builder.addVertices<2>(mesh.texcoords);
  }
  // The largest 16-bit index is not a vertex in glTF: it restarts strips.
  const bool isSmall = mesh.positions.size() <= std::numeric_limits<std::uint16_t>::max();
  const int indices = isSmall ? builder.addIndices<std::uint16_t>(mesh.indices)
                              : builder.addIndices<std::uint32_t>(mesh.indices);

  json document = std::move(builder.document);
  const json& name = material.at("name");
  document["asset"] = {
      {"version", "2.0"}, {"generator", "glint"}, {"copyright", "MIT, the glint authors"}};
  document["scene"] = 0;
  document["scenes"] = {{{"nodes", {0}}}};
  document["nodes"] = {{{"mesh", 0}, {"name", name}}};
  document["meshes"] = {
      {{"name", name},
       {"primitives", {{{"attributes", attributes}, {"indices", indices}, {"material", 0}}}}}};
  document["materials"] = json::array({material});
  document["buffers"] = {{{"byteLength", builder.buffer.size()}}};

  std::string chunks;
  appendChunk(chunks, "JSON", document.dump(), ' ');
  appendChunk(chunks, "BIN\0", builder.buffer, '\0');
  std::string file = "glTF";
  append(file, std::uint32_t{2});
  append(file, static_cast<std::uint32_t>(12 + chunks.size()));
  return file + chunks;
}

}  // namespace glint::models
