#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <glm/glm.hpp>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

/// Reads the files in models/ for their tests, independently of the project's reader.
namespace shipped {

using nlohmann::json;

inline const std::filesystem::path folder = GLINT_SOURCE_DIR "/models";

/// A coordinate of magnitude at most 1 is off by at most half an ulp, 2^-25, when rounded to float;
/// a point by sqrt(3) times that.
inline constexpr double rounding = 5.2e-8;

inline std::string readFile(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

inline std::uint32_t wordAt(const std::string& bytes, std::size_t offset) {
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data() + offset, sizeof word);
  return word;
}

/// A parsed file from models/; parsing also tests the container.
struct Model {
  json document;
  std::string buffer;
  std::vector<glm::dvec3> positions, normals;
  std::vector<glm::dvec2> texcoords;
  std::vector<std::uint32_t> indices;

  std::size_t triangleCount() const { return indices.size() / 3; }
  glm::dvec3 corner(std::size_t triangle, int i) const {
    return positions[indices[3 * triangle + i]];
  }
  /// Twice the area times the unit normal of the counter-clockwise side.
  glm::dvec3 faceNormal(std::size_t triangle) const {
    const glm::dvec3 a = corner(triangle, 0);
    return glm::cross(corner(triangle, 1) - a, corner(triangle, 2) - a);
  }
};

template <typename T, int Size>
std::vector<glm::vec<Size, double>> readVectors(const Model& model, int accessor) {
  const json& a = model.document["accessors"][accessor];
  const json& view = model.document["bufferViews"][a["bufferView"].get<int>()];
  std::vector<glm::vec<Size, double>> values;
  for (std::size_t i = 0; i < a["count"]; ++i) {
    T stored[Size];
    const std::size_t offset = view["byteOffset"].get<std::size_t>() + i * sizeof stored;
    EXPECT_LE(offset + sizeof stored, model.buffer.size());
    std::memcpy(stored, model.buffer.data() + offset, sizeof stored);
    glm::vec<Size, double> value;
    for (int k = 0; k < Size; ++k) {
      value[k] = stored[k];
    }
    values.push_back(value);
  }
  return values;
}

inline Model load(const std::string& name) {
  SCOPED_TRACE(name);
  const std::string bytes = readFile(folder / name);
  Model model;
  if (bytes.size() < 20) {
    ADD_FAILURE() << "missing";
    return model;
  }
  const std::size_t jsonLength = wordAt(bytes, 12);
  model.document = json::parse(bytes.substr(20, jsonLength));
  model.buffer = bytes.substr(28 + jsonLength);
  const json& primitive = model.document["meshes"][0]["primitives"][0];
  const json& attributes = primitive["attributes"];
  model.positions = readVectors<float, 3>(model, attributes["POSITION"]);
  model.normals = readVectors<float, 3>(model, attributes["NORMAL"]);
  if (attributes.contains("TEXCOORD_0")) {
    model.texcoords = readVectors<float, 2>(model, attributes["TEXCOORD_0"]);
  }
  EXPECT_EQ(model.document["accessors"][primitive["indices"].get<int>()]["componentType"], 5123);
  for (const auto& index : readVectors<std::uint16_t, 1>(model, primitive["indices"])) {
    model.indices.push_back(static_cast<std::uint32_t>(index.x));
  }
  return model;
}

/// The number of edges with a triangle on only one side, where vertices at the same place count as
/// one. Fails if adjacent triangles have opposite winding.
inline std::size_t openEdges(const Model& model) {
  const auto less = [](const glm::dvec3& a, const glm::dvec3& b) {
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
  };
  std::map<glm::dvec3, std::size_t, decltype(less)> places(less);
  std::map<std::pair<std::size_t, std::size_t>, int> edges;
  for (std::size_t i = 0; i < model.indices.size(); ++i) {
    const auto placeOf = [&](std::size_t k) {
      return places.try_emplace(model.positions[model.indices[k]], places.size()).first->second;
    };
    const std::size_t next = i % 3 == 2 ? i - 2 : i + 1;
    EXPECT_EQ(++edges[std::pair(placeOf(i), placeOf(next))], 1) << "triangle " << i / 3;
  }
  return std::count_if(edges.begin(), edges.end(), [&](const auto& edge) {
    return !edges.contains({edge.first.second, edge.first.first});
  });
}

/// By the divergence theorem; positive if the triangles of a closed surface face outwards.
inline double volume(const Model& model) {
  double sum = 0.0;
  for (std::size_t t = 0; t < model.triangleCount(); ++t) {
    sum += glm::dot(model.corner(t, 0), model.faceNormal(t)) / 6.0;
  }
  return sum;
}

/// No triangle is degenerate, and its counter-clockwise side is that of its vertices' normals.
inline void expectFacesFollowNormals(const Model& model) {
  for (std::size_t t = 0; t < model.triangleCount(); ++t) {
    ASSERT_GT(glm::length(model.faceNormal(t)), 1e-7) << "triangle " << t;
    for (int i = 0; i < 3; ++i) {
      const glm::dvec3 normal = model.normals[model.indices[3 * t + i]];
      ASSERT_GT(glm::dot(model.faceNormal(t), normal), 0.0) << "triangle " << t;
    }
  }
}

}  // namespace shipped
