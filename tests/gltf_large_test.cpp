// Long buffers are read in pieces if a model is static, and whole if it may move: the scene must be
// the same.

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

#include "files.h"
#include "glint/gltf/scene_file.h"
#include "gltf_text.h"

namespace gltf_large_test {

using Json = nlohmann::json;

constexpr std::size_t vertices = 600'000, stride = 36;  // 21 MB, interleaved

// Position, normal, texture coordinates and a colour of four bytes for each vertex; 16-bit and
// 32-bit indices; one sparse value.
std::string writeBuffer(const std::string& folder) {
  std::string bytes(vertices * stride, '\0');
  for (std::size_t i = 0; i < vertices; ++i) {
    const float v[8] = {
        float(i % 1000),  float(i / 1000), float(std::sin(double(i))), 0.6F, 0, 0.8F,
        float(i % 7) / 7, float(i % 5) / 5};
    std::memcpy(&bytes[i * stride], v, sizeof v);
    const unsigned char color[4] = {static_cast<unsigned char>(i), 10, 20, 255};
    std::memcpy(&bytes[i * stride + 32], color, 4);
  }
  const auto put = [&](const auto& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  for (std::uint32_t i = 0; i + 2 < vertices; i += 3)
    for (const std::uint32_t k : {i, i + 1, i + 2}) put(k);
  for (const std::uint16_t i : {5, 6, 7, 7, 6, 9}) put(i);
  put(std::uint32_t(5));
  for (const float f : {1.5F, 2.5F, 3.5F}) put(f);
  std::ofstream(folder + "/large.bin", std::ios::binary) << bytes;
  return bytes;
}

Json modelOf(std::size_t size) {
  const std::size_t indices = vertices * stride, shorts = indices + 4 * vertices,
                    sparse = shorts + 12;
  const auto accessor = [](int view, int component, std::size_t count, const char* type,
                           std::size_t offset = 0) {
    return Json{{"bufferView", view},
                {"byteOffset", offset},
                {"componentType", component},
                {"count", count},
                {"type", type}};
  };
  Json colors = accessor(0, 5121, vertices, "VEC4", 32);
  colors["normalized"] = true;
  Json moved = accessor(0, 5126, vertices, "VEC3");
  moved["sparse"] = {{"count", 1},
                     {"indices", {{"bufferView", 3}, {"componentType", 5125}}},
                     {"values", {{"bufferView", 3}, {"byteOffset", 4}}}};
  const Json attributes = {{"POSITION", 0}, {"NORMAL", 1}, {"COLOR_0", 3}};
  Json other = attributes;
  other["POSITION"] = 6;
  const auto view = [](std::size_t offset, std::size_t length) {
    return Json{{"buffer", 0}, {"byteOffset", offset}, {"byteLength", length}};
  };
  Json interleaved = view(0, indices);
  interleaved["byteStride"] = stride;
  return {{"asset", {{"version", "2.0"}}},
          {"scene", 0},
          {"scenes", {{{"nodes", {0}}}}},
          {"nodes", {{{"mesh", 0}}}},
          {"materials", {{{"name", "paint"}}}},
          {"meshes",
           {{{"primitives",
              {{{"attributes", attributes}, {"indices", 4}, {"material", 0}},
               {{"attributes", other}, {"indices", 5}, {"material", 0}}}}}}},
          {"buffers", {{{"uri", "large.bin"}, {"byteLength", size}}}},
          {"bufferViews",
           {interleaved, view(indices, 4 * vertices), view(shorts, 12), view(sparse, 16)}},
          {"accessors",
           {accessor(0, 5126, vertices, "VEC3"), accessor(0, 5126, vertices, "VEC3", 12),
            accessor(0, 5126, vertices, "VEC2", 24), colors,
            accessor(1, 5125, vertices / 3 * 3, "SCALAR"), accessor(2, 5123, 6, "SCALAR"), moved}}};
}

TEST(LargeGltf, IsTheSameInPiecesAndWhole) {
  const std::string folder = glint::test::temporaryFolder();
  const std::string bytes = writeBuffer(folder);
  Json json = modelOf(bytes.size());
  std::ofstream(folder + "/still.gltf") << json;
  json["extensionsUsed"] = {"KHR_materials_variants"};
  json["extensions"]["KHR_materials_variants"]["variants"] = {{{"name", "one"}}};
  std::ofstream(folder + "/moving.gltf") << json;
  const glint::Scene still = glint::loadGltf(folder + "/still.gltf");
  const glint::Scene moving = glint::loadGltf(folder + "/moving.gltf");
  ASSERT_EQ(still.meshes.size(), 2u);
  ASSERT_EQ(moving.meshes.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    const glint::Mesh &a = still.meshes[i], &b = moving.meshes[i];
    EXPECT_TRUE(a.positions == b.positions);
    EXPECT_TRUE(a.normals == b.normals);
    EXPECT_TRUE(a.colors == b.colors);
    EXPECT_TRUE(a.indices == b.indices);
    EXPECT_EQ(a.normalsMayCancel, b.normalsMayCancel);
  }
  // And it must be what was written.
  const glint::Mesh& mesh = still.meshes[0];
  ASSERT_EQ(mesh.positions.size(), vertices);
  for (const std::size_t i : {std::size_t(0), std::size_t(1234), vertices - 1}) {
    EXPECT_EQ(mesh.positions[i],
              glm::vec3(float(i % 1000), float(i / 1000), float(std::sin(double(i)))));
    EXPECT_NEAR(mesh.normals[i].x, 0.6, 1e-7);
    EXPECT_EQ(mesh.colors[i].r, float(i % 256 / 255.0));
    EXPECT_EQ(mesh.indices[i], i);
  }
  const glint::Mesh& few = still.meshes[1];
  ASSERT_EQ(few.positions.size(), 4u);
  EXPECT_EQ(few.positions[0], glm::vec3(1.5F, 2.5F, 3.5F));
}

TEST(LargeGltf, OfAFileCutShortIsRefused) {
  const std::string folder = glint::test::temporaryFolder();
  const std::string bytes = writeBuffer(folder);
  std::ofstream(folder + "/still.gltf") << modelOf(bytes.size());
  std::filesystem::resize_file(folder + "/large.bin", bytes.size() - 5);
  EXPECT_NE(glint::test::messageOf([&] {
              glint::loadGltf(folder + "/still.gltf");
            }).find("buffers[0] declares"),
            std::string::npos);
}

}  // namespace gltf_large_test
