// Accessors, primitive modes, and the hard cases of vertex attributes.
#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "gltf_sample.h"

namespace glint::gltf_geometry_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using Json = Sample::Json;

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

/// Components agree up to float rounding: 1 ulp of a value up to 1.
void expectNear(const glm::vec3& a, const glm::vec3& b, float tolerance = 6e-8f) {
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(a[k], b[k], tolerance)
        << a.x << " " << a.y << " " << a.z << " against " << b.x << " " << b.y << " " << b.z;
  }
}

/// The mesh that a primitive mode makes of a pentagon's positions.
glint::Mesh meshOfMode(int mode, int count = 5) {
  Sample sample;
  std::vector<float> positions;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * 3.14159265358979 * i / count;
    positions.insert(positions.end(), {float(std::cos(angle)), float(std::sin(angle)), 0});
  }
  std::vector<float> normals(positions.size(), 1);
  sample.primitive({{"attributes",
                     {{"POSITION", sample.accessor("VEC3", positions)},
                      {"NORMAL", sample.accessor("VEC3", normals)}}},
                    {"mode", mode}});
  const glint::Scene scene = sample.load();
  return scene.meshes.empty() ? glint::Mesh() : scene.meshes[0];
}

TEST(GltfGeometry, PrimitiveModes) {
  EXPECT_EQ(meshOfMode(0).topology, Topology::points);
  EXPECT_THAT(meshOfMode(0).indices, ElementsAre(0, 1, 2, 3, 4));
  ASSERT_EQ(meshOfMode(0).normals.size(), 5u);
  EXPECT_NEAR(meshOfMode(1).normals[0].x, std::sqrt(1 / 3.0), 1e-7);
  EXPECT_EQ(meshOfMode(1).topology, Topology::lines);
  EXPECT_THAT(meshOfMode(1).indices, ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(meshOfMode(2).indices, ElementsAre(0, 1, 1, 2, 2, 3, 3, 4, 4, 0));
  EXPECT_THAT(meshOfMode(3).indices, ElementsAre(0, 1, 1, 2, 2, 3, 3, 4));
  EXPECT_EQ(meshOfMode(3).topology, Topology::lines);
  EXPECT_THAT(meshOfMode(4).indices, ElementsAre(0, 1, 2));
  EXPECT_EQ(meshOfMode(4).positions.size(), 3u);  // the two at the end make no triangle
  // glTF 2.0, section 3.7.2.1: p_i, p_(i + 1 + i mod 2), p_(i + 2 - i mod 2).
  EXPECT_THAT(meshOfMode(5).indices, ElementsAre(0, 1, 2, 1, 3, 2, 2, 3, 4));
  EXPECT_THAT(meshOfMode(6).indices, ElementsAre(1, 2, 0, 2, 3, 0, 3, 4, 0));
  for (const int mode : {1, 2, 3, 4, 5, 6}) EXPECT_THAT(meshOfMode(mode, 1).indices, IsEmpty());
}

TEST(GltfGeometry, RestOfAListIsLeftOutWithAWarning) {
  Sample sample;
  sample.triangle()["indices"] = sample.accessor<std::uint8_t>("SCALAR", {0, 1, 2, 0, 1});
  const glint::Scene scene = sample.load();
  EXPECT_EQ(scene.meshes.at(0).indices.size(), 3u);
  EXPECT_THAT(scene.warnings, ElementsAre(HasSubstr("meshes[0] \"Part\", primitives[0]: has 2")));
}

template <typename Index>
void expectIndicesWork() {
  Sample sample;
  Json& primitive = sample.triangle();
  primitive["indices"] = sample.accessor<Index>("SCALAR", {2, 0, 1});
  EXPECT_EQ(sample.load().meshes.at(0).positions.at(0), glm::vec3(0, 1, 0));
  primitive["indices"] = sample.accessor<Index>("SCALAR", {2, 0, 3});
  EXPECT_THAT(sample.error(), HasSubstr("meshes[0] \"Part\", primitives[0], index 2 is 3, but "
                                        "there are only 3 vertices"));
  primitive["indices"] =
      sample.accessor<Index>("SCALAR", {0, 1, std::numeric_limits<Index>::max()});
  EXPECT_THAT(sample.error(), HasSubstr("there are only 3 vertices"));
}

TEST(GltfGeometry, IndexTypes) {
  expectIndicesWork<std::uint8_t>();
  expectIndicesWork<std::uint16_t>();
  expectIndicesWork<std::uint32_t>();
}

TEST(GltfGeometry, DegenerateTrianglesAndUnusedVerticesAreLeftOut) {
  Sample sample;
  const int position =
      sample.accessor<float>("VEC3", {9, 9, 9, 0, 0, 0, 1, 0, 0, 0, 1, 0, 7, 7, nan});
  const int normal = sample.accessor<float>("VEC3", std::vector<float>(15, 1));
  sample.primitive({{"attributes", {{"POSITION", position}, {"NORMAL", normal}}},
                    {"indices", sample.accessor<std::uint8_t>("SCALAR", {1, 2, 3, 0, 0, 4})}});
  const glint::Scene scene = sample.load();
  EXPECT_THAT(scene.warnings, IsEmpty());
  EXPECT_THAT(scene.meshes.at(0).indices, ElementsAre(0, 1, 2));
  EXPECT_EQ(scene.meshes.at(0).positions.size(), 3u);
}

TEST(GltfGeometry, FewIndicesIntoALargeAccessor) {
  Sample sample;
  std::vector<float> positions(3 * 10000);
  for (std::size_t i = 0; i < positions.size(); ++i) positions[i] = float(i * i % 1009);
  const std::vector<float> normals(positions.size(), 1);
  sample.primitive({{"attributes",
                     {{"POSITION", sample.accessor("VEC3", positions)},
                      {"NORMAL", sample.accessor("VEC3", normals)}}},
                    {"indices", sample.accessor<std::uint16_t>("SCALAR", {9999, 5, 700})}});
  const glint::Mesh mesh = sample.load().meshes.at(0);
  EXPECT_THAT(mesh.indices, ElementsAre(2, 0, 1));
  for (const int k : {0, 1, 2}) {
    EXPECT_EQ(mesh.positions.at(2)[k], positions[std::size_t(3 * 9999 + k)]);
  }
}

TEST(GltfGeometry, InterleavedAndUnalignedViews) {
  Sample sample;
  // position, 4 bytes of padding, texcoord as u8: stride 20
  std::vector<unsigned char> bytes(60);
  const float positions[] = {0, 0, 0, 2, 0, 0, 0, 3, 0};
  for (std::size_t i = 0; i < 3; ++i) {
    std::memcpy(&bytes[i * 20 + 1], &positions[3 * i], 12);  // off by one byte
  }
  const int view = sample.view(bytes);
  sample.json["bufferViews"][0]["byteStride"] = 20;
  const int position = sample.add("accessors", {{"bufferView", view},
                                                {"byteOffset", 1},
                                                {"componentType", 5126},
                                                {"type", "VEC3"},
                                                {"count", 3}});
  sample.primitive({{"attributes", {{"POSITION", position}}}});
  const glint::Mesh mesh = sample.load().meshes.at(0);
  EXPECT_EQ(mesh.positions.at(1), glm::vec3(2, 0, 0));
  EXPECT_EQ(mesh.positions.at(2), glm::vec3(0, 3, 0));
}

TEST(GltfGeometry, SparseAccessorWithAndWithoutABase) {
  Sample sample;
  sample.triangle();
  const int indices = sample.view<std::uint8_t>({2, 1});
  const int values = sample.view<float>({0, 5, 0, 4, 0, 0});
  Json& accessor = sample.json["accessors"][0];
  accessor["sparse"] = {{"count", 2},
                        {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
                        {"values", {{"bufferView", values}}}};
  EXPECT_EQ(sample.load().meshes.at(0).positions.at(2), glm::vec3(0, 5, 0));
  accessor.erase("bufferView");
  EXPECT_EQ(sample.load().meshes.at(0).positions.at(1), glm::vec3(4, 0, 0));
  accessor["sparse"]["indices"]["bufferView"] = sample.view<std::uint8_t>({2, 3});
  EXPECT_THAT(sample.error(), HasSubstr("accessors[0].sparse has the index 3 of 3"));
}

TEST(GltfGeometry, WholeNumberAttributes) {
  Sample sample;
  const int position = sample.accessor<std::int16_t>("VEC3", {0, 0, 0, 300, 0, 0, 0, -32768, 0});
  const int normal = sample.accessor<std::int8_t>("VEC3", {0, 0, 127, 0, 0, -128, 0, 1, 0});
  sample.json["accessors"][1]["normalized"] = true;
  const int color =
      sample.accessor<std::uint8_t>("VEC4", {255, 0, 51, 255, 0, 0, 0, 0, 255, 255, 255, 51});
  sample.primitive(
      {{"attributes", {{"POSITION", position}, {"NORMAL", normal}, {"COLOR_0", color}}}});
  glint::Mesh mesh = sample.load().meshes.at(0);
  EXPECT_EQ(mesh.positions.at(1), glm::vec3(300, 0, 0));
  EXPECT_EQ(mesh.positions.at(2), glm::vec3(0, -32768, 0));
  EXPECT_EQ(mesh.normals.at(1), glm::vec3(0, 0, -1));
  EXPECT_EQ(mesh.colors.at(0), glm::vec4(1, 0, 0.2f, 1));
  EXPECT_EQ(mesh.colors.at(2).a, 0.2f);
  sample.json["accessors"][0]["normalized"] = true;
  mesh = sample.load().meshes.at(0);
  EXPECT_EQ(mesh.positions.at(2), glm::vec3(0, -1, 0));
  EXPECT_EQ(mesh.positions.at(1).x, 300 / 32767.0f);
}

TEST(GltfGeometry, VertexColors) {
  Sample sample;
  Json& attributes = sample.triangle()["attributes"];
  attributes["COLOR_0"] = sample.accessor<float>("VEC3", {2, 0, 0.5f, nan, -1, 1, 0, 0, 0});
  const glint::Scene scene = sample.load();
  EXPECT_EQ(scene.meshes.at(0).colors.at(0), glm::vec4(1, 0, 0.5f, 1));
  EXPECT_EQ(scene.meshes.at(0).colors.at(1), glm::vec4(1, 0, 1, 1));
  EXPECT_THAT(scene.warnings, ElementsAre(HasSubstr("colours that are not finite")));
  attributes["COLOR_0"] = sample.accessor<float>("VEC2", {0, 0, 0, 0, 0, 0});
  EXPECT_THAT(sample.error(), HasSubstr("COLOR_0 must have 3 or 4 components"));
  attributes["COLOR_0"] = sample.accessor<float>("VEC3", {0, 0, 0});
  EXPECT_THAT(sample.error(), HasSubstr("COLOR_0 has 1 entries for 3 vertices"));
}

// A1 to A8, A10
TEST(GltfGeometry, NormalsOfAnyLength) {
  const float third = 1 / 3.0f, root = std::sqrt(0.5f);
  struct Case {
    glm::vec3 file, expected;
    bool mended;
  };
  const Case cases[] = {{{0, 0, 0}, {0, 0, 1}, true},
                        {{1e-20f, 0, 0}, {1, 0, 0}, false},
                        {{1e-23f, 2e-23f, 2e-23f}, {third, 2 * third, 2 * third}, false},
                        {{1e-38f, 1e-38f, 0}, {root, root, 0}, false},
                        {{1e-45f, 0, 0}, {1, 0, 0}, false},
                        {{1e20f, 1e20f, 0}, {root, root, 0}, false},
                        {{3e38f, 3e38f, 3e38f}, glm::vec3(std::sqrt(third)), false},
                        {{infinity, 0, 0}, {0, 0, 1}, true},
                        {{nan, 0, 0}, {0, 0, 1}, true},
                        {{1, 2, nan}, {0, 0, 1}, true},
                        {{-0.0f, 0, 0}, {0, 0, 1}, true},
                        {{0, 0.5f, 0}, {0, 1, 0}, false},
                        {{2, 0, 0}, {1, 0, 0}, false}};
  for (const Case& c : cases) {
    Sample sample;
    const glm::vec3 n = c.file;
    sample.triangle()["attributes"]["NORMAL"] =
        sample.accessor<float>("VEC3", {0, 1, 0, n.x, n.y, n.z, 1, 0, 0});
    const glint::Scene scene = sample.load();
    expectNear(scene.meshes.at(0).normals.at(1), c.expected);
    EXPECT_EQ(scene.meshes.at(0).positions.size(), 3u);
    if (c.mended) {
      EXPECT_THAT(scene.warnings, ElementsAre(HasSubstr("1 of 3 normals are zero or not finite")));
    } else {
      EXPECT_THAT(scene.warnings, IsEmpty());
    }
  }
}

TEST(GltfGeometry, MendedNormalIsTheMeanWeightedByArea) {
  // Two triangles that share an edge: area 2 facing +Z, area 1 facing +X.
  Sample sample;
  const int position = sample.accessor<float>("VEC3", {0, 0, 0, 0, 1, 0, -4, 0, 0, 0, 0, -2});
  const int normal = sample.accessor<float>("VEC3", {0, 0, 0, 0, 0, 1, 0, 0, 1, 1, 0, 0});
  sample.primitive({{"attributes", {{"POSITION", position}, {"NORMAL", normal}}},
                    {"indices", sample.accessor<std::uint8_t>("SCALAR", {0, 1, 2, 0, 3, 1})}});
  expectNear(sample.load().meshes.at(0).normals.at(0), glm::vec3(1, 0, 2) / std::sqrt(5.0f));
  // Opposite faces cancel: the normal of one of them is used.
  sample.json["accessors"][0] = sample.json["accessors"][static_cast<std::size_t>(
      sample.accessor<float>("VEC3", {0, 0, 0, 0, 1, 0, -1, 0, 0, -1, 0, 0}))];
  expectNear(sample.load().meshes.at(0).normals.at(0), {0, 0, 1});
}

// A18, A12
TEST(GltfGeometry, MissingNormalsAreFlat) {
  Sample sample;
  const int position = sample.accessor<float>("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1});
  const int color = sample.accessor<float>("VEC3", {1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1});
  sample.primitive({{"attributes", {{"POSITION", position}, {"COLOR_0", color}}},
                    {"indices", sample.accessor<std::uint8_t>("SCALAR", {0, 1, 2, 0, 2, 3})}});
  const glint::Scene scene = sample.load();
  const glint::Mesh& mesh = scene.meshes.at(0);
  EXPECT_THAT(scene.warnings, IsEmpty());
  EXPECT_THAT(mesh.indices, ElementsAre(0, 1, 2, 3, 4, 5));
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(mesh.normals.at(i), glm::vec3(0, 0, 1));
  for (std::size_t i = 3; i < 6; ++i) EXPECT_EQ(mesh.normals.at(i), glm::vec3(1, 0, 0));
  EXPECT_EQ(mesh.colors.at(5), glm::vec4(1));
}

TEST(GltfGeometry, FaceNormalsOfSliversAndOfNothing) {
  Sample sample;
  // A sliver 1 long and 1e-7 wide, tilted; then three collinear vertices; then one vertex three
  // times.
  const int position = sample.accessor<float>(
      "VEC3",
      {1, 1, 1, 2, 2, 1, 2, 2, 1.0000001f, 0, 0, 0, 1, 1, 1, 2, 2, 2, 5, 5, 5, 5, 5, 5, 5, 5, 5});
  sample.primitive({{"attributes", {{"POSITION", position}}}});
  const glint::Mesh mesh = sample.load().meshes.at(0);
  expectNear(mesh.normals.at(0), glm::vec3(1, -1, 0) / std::sqrt(2.0f));
  expectNear(mesh.normals.at(3), {0, 0, 1});
  expectNear(mesh.normals.at(6), {0, 0, 1});
}

// A13
TEST(GltfGeometry, NonFinitePositionsDropTheirTriangles) {
  Sample sample;
  const int position = sample.accessor<float>(
      "VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0, nan, 0, 0, infinity, 0, 0, 0, 0, 1});
  const int normal = sample.accessor<float>("VEC3", std::vector<float>(18, 1));
  const int color =
      sample.accessor<float>("VEC3", {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1, 1, 1});
  sample.primitive(
      {{"attributes", {{"POSITION", position}, {"NORMAL", normal}, {"COLOR_0", color}}},
       {"indices", sample.accessor<std::uint8_t>("SCALAR", {3, 1, 2, 0, 1, 2, 1, 4, 5, 5, 2, 0})}});
  const glint::Scene scene = sample.load();
  const glint::Mesh& mesh = scene.meshes.at(0);
  EXPECT_THAT(scene.warnings,
              ElementsAre(HasSubstr("2 of 4 triangles have a non-finite position")));
  EXPECT_THAT(mesh.indices, ElementsAre(0, 1, 2, 3, 2, 0));
  EXPECT_EQ(mesh.positions.at(3), glm::vec3(0, 0, 1));
  EXPECT_EQ(mesh.colors.at(3), glm::vec4(1));
  EXPECT_EQ(mesh.normals.size(), 4u);
}

TEST(GltfGeometry, OnlyNonFinitePositionsLeaveNothing) {
  Sample sample;
  sample.primitive(
      {{"attributes", {{"POSITION", sample.accessor<float>("VEC3", std::vector<float>(9, nan))}}}});
  const glint::Scene scene = sample.load();
  EXPECT_THAT(scene.meshes, IsEmpty());
  EXPECT_THAT(scene.warnings, ElementsAre(HasSubstr("1 of 1 triangles"), "nothing to draw"));
}

// B8
TEST(GltfGeometry, MeshFarFromItsOriginIsStoredRelative) {
  Sample sample;
  sample.primitive({{"attributes",
                     {{"POSITION", sample.accessor<float>(
                                       "VEC3", {1e6f, 0, 0, 1e6f + 1, 0, 0, 1e6f, 0.1f, 0})}}}});
  const glint::Mesh mesh = sample.load().meshes.at(0);
  EXPECT_EQ(mesh.origin, glm::dvec3(1000000.5, double(0.1f) / 2, 0));
  EXPECT_EQ(mesh.positions.at(0).x, -0.5f);
  EXPECT_EQ(mesh.origin.y + double(mesh.positions.at(2).y), double(0.1f));
  Sample near;
  near.triangle();
  EXPECT_EQ(near.load().meshes.at(0).origin, glm::dvec3(0));
}

TEST(GltfGeometry, PrimitiveWithoutPositionsIsLeftOut) {
  Sample sample;
  sample.triangle()["attributes"] = Json::object();
  EXPECT_THAT(sample.load().warnings, ElementsAre(HasSubstr("has no POSITION"), "nothing to draw"));
}

// A19
TEST(GltfGeometry, MoreVerticesThanFloatCanCount) {
  Sample sample;
  constexpr std::uint32_t count = (1u << 24) + 2;
  sample.triangle();
  sample.binary.resize(std::size_t(count) * 4);
  const std::uint8_t last[] = {7, 8, 9};
  std::memcpy(&sample.binary[(std::size_t(count) - 1) * 4], last, 3);
  sample.json["bufferViews"][0] = {
      {"buffer", 0}, {"byteLength", sample.binary.size()}, {"byteStride", 4}};
  sample.json["accessors"][0] = {
      {"bufferView", 0}, {"componentType", 5121}, {"type", "VEC3"}, {"count", count}};
  sample.json["meshes"][0]["primitives"][0]["indices"] =
      sample.accessor<std::uint32_t>("SCALAR", {0, count - 2, count - 1});
  const glint::Mesh mesh = sample.load().meshes.at(0);
  EXPECT_EQ(mesh.positions.at(2), glm::vec3(7, 8, 9));
}

}  // namespace glint::gltf_geometry_test
