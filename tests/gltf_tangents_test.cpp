// Tangents for normal maps: from the file, and computed as in MikkTSpace.
#include <gmock/gmock.h>

#include <chrono>
#include <cmath>

#include "glint/gltf/tangents.h"
#include "gltf_sample.h"
#include "scenes.h"

namespace glint::test::gltf_tangents_test {

using glint::gltf::makeTangents;
using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A square seen from +Z with an upright texture: u to the right, v downwards.
Mesh square() {
  Mesh mesh = glint::test::quad();
  mesh.texcoords = {{{0, 1}, {1, 1}, {1, 0}, {0, 0}}};
  return mesh;
}

void makeTangents(Mesh& mesh) { makeTangents(mesh, mesh.texcoords[0]); }

TEST(Tangents, OfAnUprightPicturePointRightWithBitangentsUp) {
  Mesh mesh = square();
  makeTangents(mesh);
  EXPECT_EQ(mesh.positions.size(), 4u);
  EXPECT_THAT(mesh.tangents, Each(glm::vec4(1, 0, 0, 1)));
}

TEST(Tangents, OfAMirroredPictureHaveTheOtherHandedness) {
  Mesh mesh = square();
  for (glm::vec2& t : mesh.texcoords[0]) t.x = 1 - t.x;
  makeTangents(mesh);
  EXPECT_THAT(mesh.tangents, Each(glm::vec4(-1, 0, 0, -1)));
}

TEST(Tangents, VerticesBetweenMirroredHalvesAreSplit) {
  // Two squares side by side, the right one's texture mirrored.
  Mesh mesh;
  mesh.positions = {{-1, 0, 0}, {0, 0, 0}, {1, 0, 0}, {-1, 1, 0}, {0, 1, 0}, {1, 1, 0}};
  mesh.normals.assign(6, {0, 0, 1});
  mesh.texcoords = {{{0, 1}, {1, 1}, {0, 1}, {0, 0}, {1, 0}, {0, 0}}};
  mesh.indices = {0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4};
  makeTangents(mesh);
  EXPECT_EQ(mesh.positions.size(), 8u);
  EXPECT_EQ(mesh.tangents.size(), 8u);
  EXPECT_EQ(mesh.texcoords[0].size(), 8u);
  for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
    const float side = i < 6 ? 1.0f : -1.0f;
    EXPECT_EQ(mesh.tangents[mesh.indices[i]], glm::vec4(side, 0, 0, side)) << i;
  }
}

TEST(Tangents, AreMeansByAngleOfWhatMeetsAtAVertex) {
  // A fold along y: the left face lies in the plane z = 0, the right one falls by 45 degrees. At
  // the fold's vertices their tangents are combined in the plane of the mean normal.
  const float h = std::sqrt(0.5f);
  Mesh mesh;
  mesh.positions = {{-1, 0, 0}, {0, 0, 0}, {h, 0, -h}, {-1, 1, 0}, {0, 1, 0}, {h, 1, -h}};
  const glm::vec3 n = glm::normalize(glm::vec3(h, 0, 1 + h));
  mesh.normals = {{0, 0, 1}, n, {h, 0, h}, {0, 0, 1}, n, {h, 0, h}};
  mesh.texcoords = {{{0, 1}, {1, 1}, {2, 1}, {0, 0}, {1, 0}, {2, 0}}};
  mesh.indices = {0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4};
  makeTangents(mesh);
  ASSERT_EQ(mesh.positions.size(), 6u);
  const glm::vec3 expected(n.z, 0, -n.x);
  for (const std::size_t i : {1, 4})
    EXPECT_LT(glm::length(glm::vec3(mesh.tangents[i]) - expected), 1e-6f);
  EXPECT_EQ(mesh.tangents[0], glm::vec4(1, 0, 0, 1));
}

TEST(Tangents, EqualVerticesOfDifferentIndicesAreOne) {
  Mesh mesh = square();
  mesh.normals[0] = mesh.normals[2] = glm::normalize(glm::vec3(0.1f, 0, 1));
  Mesh apart;
  for (const std::uint32_t i : mesh.indices) {
    apart.indices.push_back(std::uint32_t(apart.positions.size()));
    apart.positions.push_back(mesh.positions[i]);
    apart.normals.push_back(mesh.normals[i]);
    apart.texcoords.resize(1);
    apart.texcoords[0].push_back(mesh.texcoords[0][i]);
  }
  makeTangents(mesh);
  makeTangents(apart);
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_EQ(apart.tangents[i], mesh.tangents[mesh.indices[i]]) << i;
}

TEST(Tangents, FacesWithoutAreaInThePictureFollowTheirNeighbours) {
  Mesh mesh = square();
  mesh.texcoords[0][3] = mesh.texcoords[0][2];  // the second triangle is degenerate in the texture
  makeTangents(mesh);
  for (const glm::vec4& t : mesh.tangents) EXPECT_NEAR(glm::length(glm::vec3(t)), 1, 1e-6);
  Mesh none = square();
  none.texcoords[0].assign(4, {0, 0});
  makeTangents(none);
  for (const glm::vec4& t : none.tangents) {
    EXPECT_NEAR(glm::length(glm::vec3(t)), 1, 1e-6);
    EXPECT_EQ(t.z, 0);
  }
}

TEST(Tangents, AFanOfAHundredThousandFacesAroundOneEdgeTakesNoAge) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {0, 1, 0}};
  mesh.texcoords = {{{0, 0}, {0, 1}}};
  for (std::uint32_t i = 0; i < 100000; ++i) {
    mesh.positions.push_back({1, 0, float(i)});
    mesh.texcoords[0].push_back({1, float(i)});
    mesh.indices.insert(mesh.indices.end(), {0, 1, i + 2});
  }
  mesh.normals.assign(mesh.positions.size(), {0, 0, 1});
  const auto start = std::chrono::steady_clock::now();
  makeTangents(mesh);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
  EXPECT_EQ(mesh.tangents.size(), mesh.positions.size());
}

/// A triangle whose material has a normal map.
struct Mapped : Sample {
  Mapped() {
    Json& primitive = triangle();
    primitive["attributes"]["NORMAL"] = accessor<float>("VEC3", {0, 0, 1, 0, 0, 1, 0, 0, 1});
    primitive["attributes"]["TEXCOORD_0"] = accessor<float>("VEC2", {0, 1, 1, 1, 0, 0});
    primitive["material"] = 0;
    json["materials"] = {{{"normalTexture", {{"index", 0}, {"scale", 0.5}}}}};
    json["textures"] = {{{"source", 0}}};
    json["images"] = {
        {{"bufferView", view<std::uint8_t>({0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'})}}};
  }
};

TEST(Tangents, AreMadeOnlyForMaterialsWithANormalMap) {
  Mapped sample;
  const glint::Scene with = sample.load();
  EXPECT_EQ(with.meshes.at(0).tangents.size(), 3u);
  EXPECT_EQ(with.materials.at(0).normalScale, 0.5);
  EXPECT_TRUE(with.images.at(0).isData);
  sample.json["materials"] = {{{"name", "plain"}}};
  EXPECT_THAT(sample.load().meshes.at(0).tangents, IsEmpty());
}

TEST(Tangents, OfTheFileAreTakenAndMended) {
  Mapped sample;
  auto& attributes = sample.json["meshes"][0]["primitives"][0]["attributes"];
  attributes["TANGENT"] = sample.accessor<float>("VEC4", {0, 2, 0, -1, 0, 2, 0, -1, 0, 2, 0, -1});
  EXPECT_THAT(sample.load().meshes.at(0).tangents, Each(glm::vec4(0, 1, 0, -1)));
  attributes["TANGENT"] = sample.accessor<float>("VEC4", {0, 2, 0, -1, 0, 0, 0, -1, 0, 2, 0, -1});
  const glint::Scene scene = sample.load();
  EXPECT_THAT(scene.warnings, testing::ElementsAre(HasSubstr("recomputed")));
  EXPECT_THAT(scene.meshes.at(0).tangents, Each(glm::vec4(1, 0, 0, 1)));
}

TEST(TextureTransform, MovesTurnsAndScalesCoordinates) {
  Mapped sample;
  auto& info = sample.json["materials"][0]["normalTexture"];
  const double angle = 0.3;
  info["extensions"]["KHR_texture_transform"] = {
      {"offset", {0.25, 0.5}}, {"rotation", angle}, {"scale", {2, 3}}, {"texCoord", 0}};
  info["texCoord"] = 5;  // overridden
  sample.json["extensionsRequired"] = {"KHR_texture_transform"};
  const glint::Texture texture = sample.load().materials.at(0).normalTexture.value();
  EXPECT_EQ(texture.texcoord, 0);
  const glm::dvec2 to = texture.transform * glm::dvec3(0.5, 0.25, 1);
  // Counter-clockwise in an image with v down: (1, 0) turns towards (0, -1).
  EXPECT_NEAR(to.x, 0.25 + 1 * std::cos(angle) + 0.75 * std::sin(angle), 1e-15);
  EXPECT_NEAR(to.y, 0.5 - 1 * std::sin(angle) + 0.75 * std::cos(angle), 1e-15);
  info["extensions"]["KHR_texture_transform"]["scale"] = {1, 2, 3};
  EXPECT_THAT(sample.error(), HasSubstr("KHR_texture_transform.scale"));
}

}  // namespace glint::test::gltf_tangents_test
