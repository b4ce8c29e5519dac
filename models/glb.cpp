#include "glb.h"

#include <bit>
#include <limits>

namespace glint::models {
namespace {

static_assert(std::endian::native == std::endian::little, "glTF is little-endian");

template <typename T>
void append(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// A chunk of a GLB file, padded to a multiple of four bytes.
void appendChunk(std::string& file, const char (&type)[5], std::string data, char filler) {
  data.resize((data.size() + 3) / 4 * 4, filler);
  append(file, static_cast<std::uint32_t>(data.size()));
  file.append(type, 4);
  file += data;
}

}  // namespace

int GlbBuilder::addValues(const void* data, std::size_t bytes, std::size_t count, json view,
                          json accessor) {
  view["buffer"] = 0;
  view["byteOffset"] = buffer_.size();
  view["byteLength"] = bytes;
  accessor["bufferView"] = document["bufferViews"].size();
  accessor["count"] = count;
  document["bufferViews"].push_back(view);
  document["accessors"].push_back(accessor);
  buffer_.append(static_cast<const char*>(data), bytes);
  buffer_.resize((buffer_.size() + 3) / 4 * 4, '\0');
  return static_cast<int>(document["accessors"].size()) - 1;
}

int GlbBuilder::addBytes(const std::vector<glm::u8vec4>& values) {
  return addValues(values.data(), values.size() * sizeof values[0], values.size(),
                   {{"target", Gl::array}, {"byteStride", 4}},
                   {{"componentType", Gl::unsignedByte}, {"type", "VEC4"}});
}

int GlbBuilder::addMatrices(const std::vector<glm::mat4>& values) {
  return addValues(values.data(), values.size() * sizeof values[0], values.size(), json::object(),
                   {{"componentType", Gl::float32}, {"type", "MAT4"}});
}

int GlbBuilder::addKeys(const std::vector<float>& values) {
  return addValues(values.data(), values.size() * sizeof values[0], values.size(), json::object(),
                   {{"componentType", Gl::float32},
                    {"type", "SCALAR"},
                    {"min", {*std::ranges::min_element(values)}},
                    {"max", {*std::ranges::max_element(values)}}});
}

int GlbBuilder::addKeys(const std::vector<glm::vec4>& values) {
  return addValues(values.data(), values.size() * sizeof values[0], values.size(), json::object(),
                   {{"componentType", Gl::float32}, {"type", "VEC4"}});
}

int GlbBuilder::addIndices(const std::vector<std::uint32_t>& indices, std::size_t vertices) {
  const auto add = [&]<typename Index>(const std::vector<Index>& stored, int componentType) {
    return addValues(stored.data(), stored.size() * sizeof(Index), stored.size(),
                     {{"target", Gl::elements}},
                     {{"componentType", componentType}, {"type", "SCALAR"}});
  };
  // The largest 16-bit index must not be used in glTF: it is the primitive restart value.
  if (vertices > std::numeric_limits<std::uint16_t>::max()) {
    return add(indices, Gl::unsignedInt);
  }
  return add(std::vector<std::uint16_t>(indices.begin(), indices.end()), Gl::unsignedShort);
}

json GlbBuilder::primitive(const Mesh& mesh, int material) {
  json attributes;
  attributes["POSITION"] = addVertices<3>(mesh.positions);
  attributes["NORMAL"] =
      mesh.normals.empty() ? attributes["POSITION"] : json(addVertices<3>(mesh.normals));
  if (!mesh.texcoords.empty()) {
    attributes["TEXCOORD_0"] = addVertices<2>(mesh.texcoords);
  }
  const int indices = addIndices(mesh.indices, mesh.positions.size());
  return {{"attributes", attributes}, {"indices", indices}, {"material", material}};
}

int GlbBuilder::addMesh(const std::string& name, const json& primitive) {
  document["meshes"].push_back({{"name", name}, {"primitives", {primitive}}});
  return static_cast<int>(document["meshes"].size()) - 1;
}

int GlbBuilder::addNode(const json& node) {
  document["nodes"].push_back(node);
  return static_cast<int>(document["nodes"].size()) - 1;
}

std::string GlbBuilder::bytes(const std::vector<int>& roots) {
  document["asset"] = {
      {"version", "2.0"}, {"generator", "glint"}, {"copyright", "MIT, the glint authors"}};
  document["scene"] = 0;
  document["scenes"] = {{{"nodes", roots}}};
  document["buffers"] = {{{"byteLength", buffer_.size()}}};

  std::string chunks;
  appendChunk(chunks, "JSON", document.dump(), ' ');
  appendChunk(chunks, "BIN\0", buffer_, '\0');
  std::string file = "glTF";
  append(file, std::uint32_t{2});
  append(file, static_cast<std::uint32_t>(12 + chunks.size()));
  return file + chunks;
}

std::string glb(const Mesh& mesh, const json& material) {
  GlbBuilder builder;
  const std::string name = material.at("name");
  builder.document["materials"] = json::array({material});
  const int index = builder.addMesh(name, builder.primitive(mesh, 0));
  return builder.bytes({builder.addNode({{"mesh", index}, {"name", name}})});
}

}  // namespace glint::models
