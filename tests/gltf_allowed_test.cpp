// Features that the standard allows but few files have, and broken files that can still be read.
#include <gmock/gmock.h>

#include <limits>

#include "files.h"
#include "glint/render/decode.h"
#include "glint/scene/camera.h"
#include "glint/shading/pbr_conversion.h"
#include "gltf_sample.h"
#include "textures.h"

namespace gltf_allowed_test {

using Json = Sample::Json;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

glint::Scene loadWith(Sample& sample, const glint::PoseRequest& request) {
  return glint::loadGltf(sample.writeGltf(), request);
}

std::string refusalOf(Sample& sample, const glint::PoseRequest& request) {
  return glint::test::messageOf([&] { loadWith(sample, request); });
}

TEST(GltfAllowed, InstancesOfANode) {
  Sample sample;
  sample.triangle();
  Json& attributes = sample.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
  attributes["TRANSLATION"] = sample.accessor<float>("VEC3", {1, 0, 0, 0, 2, 0, 0, 0, 3});
  attributes["SCALE"] = sample.accessor<float>("VEC3", {1, 1, 1, 2, 2, 2, 1, 1, 4});
  attributes["ROTATION"] = sample.accessor<std::int8_t>("VEC4", {0, 0, 0, 127, 0, 0, 127, 0,  //
                                                                 0, 0, 0, 127});
  sample.json["accessors"].back()["normalized"] = true;
  sample.json["nodes"][0]["translation"] = {10, 0, 0};
  const glint::Scene scene = sample.load();
  ASSERT_EQ(scene.instances.size(), 3u);
  EXPECT_EQ(scene.meshes.size(), 1u);  // all draw the same buffers
  EXPECT_EQ(glm::dvec3(scene.instances[0].world[3]), glm::dvec3(11, 0, 0));
  EXPECT_EQ(glm::dvec3(scene.instances[1].world[3]), glm::dvec3(10, 2, 0));
  EXPECT_EQ(glm::dvec3(scene.instances[1].world[0]), glm::dvec3(-2, 0, 0));  // half a turn
  EXPECT_EQ(scene.instances[2].world[2].z, 4);
  attributes["SCALE"] = sample.accessor<float>("VEC3", {1, 1, 1});
  EXPECT_THAT(sample.error(), HasSubstr("as many instances as the others"));
}

TEST(GltfAllowed, VariantsScenesAndTheWayUp) {
  Sample sample;
  Json& primitive = sample.triangle();
  sample.json["materials"] = {{{"name", "plain"}}, {{"name", "red"}}};
  primitive["material"] = 0;
  primitive["extensions"]["KHR_materials_variants"]["mappings"] = {
      {{"material", 1}, {"variants", {1}}}};
  sample.json["extensions"]["KHR_materials_variants"]["variants"] = {{{"name", "day"}},
                                                                     {{"name", "night"}}};
  sample.json["nodes"].push_back({{"mesh", 0}, {"translation", {0, 0, 5}}});
  sample.json["scenes"].push_back({{"name", "other"}, {"nodes", {1}}});
  EXPECT_EQ(sample.load().meshes.at(0).material, 0);
  glint::PoseRequest request;
  request.variant = "night";
  EXPECT_EQ(loadWith(sample, request).meshes.at(0).material, 1);
  request.variant = "day";
  EXPECT_EQ(loadWith(sample, request).meshes.at(0).material, 0);
  request.variant = "dusk";
  EXPECT_THAT(refusalOf(sample, request),
              HasSubstr("--variant: sample has no variant 'dusk': use"));

  // One file, in one variant after another.
  glint::SceneFile file(sample.writeGltf());
  glint::Scene scene = file.take();
  request.variant = "night";
  EXPECT_THAT(file.pose(scene, request), testing::ElementsAre(0));
  EXPECT_EQ(scene.meshes.at(0).material, 1);
  file.pose(scene, {});
  EXPECT_EQ(scene.meshes.at(0).material, 0);

  request = {};
  request.scene = "other";
  EXPECT_EQ(loadWith(sample, request).instances.at(0).world[3].z, 5);
  request.scene = "1";
  EXPECT_EQ(loadWith(sample, request).instances.at(0).world[3].z, 5);
  request.up = glint::UpAxis::plusZ;
  EXPECT_EQ(glm::dvec3(loadWith(sample, request).instances.at(0).world[3]), glm::dvec3(0, 5, 0));
  request.scene = "2";
  EXPECT_THAT(refusalOf(sample, request), HasSubstr("--scene: sample has no scene '2': use 0, 1"));

  const glm::dvec3 axes[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (int i = 0; i < 6; ++i) {
    request = {};
    request.up = glint::UpAxis(i);
    const glm::dmat3 turn(loadWith(sample, request).instances.at(0).world);
    EXPECT_EQ(turn * axes[i], glm::dvec3(0, 1, 0)) << i;
    EXPECT_EQ(glm::determinant(turn), 1) << i;
  }
}

TEST(GltfAllowed, AllAnimationsAtOnce) {
  Sample sample;
  sample.triangle();
  sample.show({{"mesh", 0}});
  for (int node = 0; node < 2; ++node) {
    Json animation;
    animation["samplers"] = {{{"input", sample.accessor<float>("SCALAR", {0, 1, 1, 2})},
                              {"output", sample.accessor<float>("VEC3", {0, 0, 0, 1, 0, 0,  //
                                                                         3, 0, 0, 4, 0, 0})}}};
    animation["channels"] = {
        {{"sampler", 0}, {"target", {{"node", node}, {"path", "translation"}}}}};
    sample.add("animations", animation);
  }
  glint::PoseRequest request;
  request.animation = "all";
  request.time = 0.5;
  glint::Scene scene = loadWith(sample, request);
  EXPECT_EQ(scene.instances.at(0).world[3].x, 0.5);
  EXPECT_EQ(scene.instances.at(1).world[3].x, 0.5);
  // Repeated times: a jump, and a warning.
  EXPECT_THAT(scene.warnings, Contains(HasSubstr("has repeated times")));
  request.time = 1;
  EXPECT_EQ(loadWith(sample, request).instances.at(0).world[3].x, 3);
  request.time = 1.5;
  EXPECT_EQ(loadWith(sample, request).instances.at(0).world[3].x, 3.5);
}

TEST(GltfAllowed, IndicesWithoutABufferViewAndMatricesWithoutPadding) {
  Sample sample;
  Json& primitive = sample.triangle();
  Json indices = {{"componentType", 5121}, {"type", "SCALAR"}, {"count", 3}};
  indices["sparse"] = {
      {"count", 2},
      {"indices", {{"bufferView", sample.view<std::uint8_t>({1, 2})}, {"componentType", 5121}}},
      {"values", {{"bufferView", sample.view<std::uint8_t>({1, 2})}}}};
  primitive["indices"] = sample.add("accessors", indices);
  EXPECT_THAT(sample.load().meshes.at(0).indices, testing::ElementsAre(0, 1, 2));
  // Two columns of two bytes, the first padded to four.
  sample.add("accessors", {{"bufferView", sample.view<std::uint8_t>({1, 2, 0, 0, 3, 4})},
                           {"componentType", 5121},
                           {"type", "MAT2"},
                           {"count", 1}});
  EXPECT_EQ(sample.error(), "");
  sample.json["bufferViews"].back()["byteLength"] = 5;
  EXPECT_THAT(sample.error(), HasSubstr("extends past the end of its buffer view"));
}

TEST(GltfAllowed, ABufferWithoutUriThatNothingReads) {
  Sample sample;
  sample.triangle();
  sample.writeGltf();
  sample.buffers = {{{"byteLength", 36}, {"uri", "sample.bin"}}, {{"byteLength", 99}}};
  sample.add("bufferViews", {{"buffer", 1}, {"byteLength", 12}});
  const glint::Scene scene = sample.load();
  EXPECT_EQ(scene.instances.size(), 1u);
  EXPECT_THAT(scene.warnings, IsEmpty());
}

TEST(GltfAllowed, MorphsOfColoursAndTexcoords) {
  Sample sample;
  Json& primitive = sample.triangle();
  sample.json["textures"] = {{{"source", 0}}};
  sample.json["images"] = {{{"uri", "data:image/png;base64,iVBORw0KGgo="}}};
  sample.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
  primitive["material"] = 0;
  primitive["attributes"]["COLOR_0"] =
      sample.accessor<float>("VEC3", {0.5f, 0, 0, 0, 0, 0, 0, 0, 0});
  primitive["attributes"]["TEXCOORD_0"] = sample.accessor<float>("VEC2", {0, 0, 1, 0, 0, 1});
  primitive["targets"] = {
      {{"COLOR_0", sample.accessor<float>("VEC3", {1, 0.5f, 0, 0, 0, 0, 0, 0, 0})},
       {"TEXCOORD_0", sample.accessor<float>("VEC2", {0.5f, 1, 0, 0, 0, 0})}}};
  sample.json["nodes"][0]["weights"] = {0.5};
  const glint::Mesh mesh = sample.load().meshes.at(0);
  EXPECT_EQ(mesh.colors.at(0), glm::vec4(1, 0.25f, 0, 1));
  EXPECT_EQ(mesh.texcoords.at(0).at(0), glm::vec2(0.25f, 0.5f));
  sample.json["nodes"][0]["weights"] = {2};
  EXPECT_EQ(sample.load().meshes.at(0).colors.at(0), glm::vec4(1, 1, 0, 1));
}

TEST(GltfAllowed, NamesWithBackslashesAndDataInCapitals) {
  Sample sample;
  sample.triangle();
  sample.writeGltf();
  std::filesystem::create_directories(sample.folder() / "sub");
  std::filesystem::copy_file(sample.folder() / "sample.bin", sample.folder() / "sub" / "a.bin");
  for (const char* uri : {"sub\\a.bin", "sub%5Ca.bin"}) {
    sample.buffers = {{{"byteLength", 36}, {"uri", uri}}};
    const glint::Scene scene = sample.load();
    EXPECT_EQ(scene.instances.size(), 1u);
    EXPECT_THAT(scene.warnings, Contains(HasSubstr("has a backslash in its name"))) << uri;
  }
  sample.buffers = {{{"byteLength", 36},
                     {"uri", "DATA:application/octet-stream;base64," + std::string(48, 'A')}}};
  EXPECT_THAT(sample.load().warnings, Contains(HasSubstr("data URI in capital letters")));
}

TEST(GltfAllowed, SpecularAndGlossiness) {
  Sample sample;
  sample.triangle()["material"] = 0;
  sample.json["materials"] = {Json::object()};
  sample.json["materials"][0]["extensions"]["KHR_materials_pbrSpecularGlossiness"] = {
      {"diffuseFactor", {0.5, 0.25, 0.125, 0.5}},
      {"specularFactor", {0.04, 0.04, 0.04}},
      {"glossinessFactor", 0.5}};
  const glint::Material plastic = sample.load().materials.at(0);
  const glint::ConvertedParameters same = glint::convertPbr({0, 0.5, 1.5, 1});
  EXPECT_EQ(plastic.shading.color, glm::dvec3(0.5, 0.25, 0.125));
  EXPECT_EQ(plastic.alpha, 0.5);
  EXPECT_EQ(plastic.shading.metalness, 0);
  EXPECT_EQ(plastic.shading.exponent, same.exponent);
  EXPECT_NEAR(plastic.shading.ior, 1.5, 1e-12);
  EXPECT_NEAR(plastic.shading.specular, same.specular, 1e-12);

  const auto [gold, color] = glint::convertSpecularGlossiness({{0, 0, 0}, {1, 0.77, 0.34}, 0.7});
  EXPECT_EQ(color, glm::dvec3(1, 0.77, 0.34));
  EXPECT_EQ(gold.metalness, 1);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isfinite(
      glint::convertSpecularGlossiness({{nan, 0, 0}, {nan, -1, 9}, nan}).first.specular));
}

// Red plastic next to gold: each texel gives what factors of its value would give.
TEST(GltfAllowed, SpecularAndGlossinessByTexels) {
  Sample sample;
  Json& primitive = sample.triangle();
  primitive["material"] = 0;
  primitive["attributes"]["TEXCOORD_0"] = sample.accessor<float>("VEC2", {0, 0, 1, 0, 0, 1});
  const auto texture = [&](const glm::ivec4& left, const glm::ivec4& right) {
    const auto bytes = glint::test::png(2, 1, [&](int x, int) { return x == 0 ? left : right; });
    const int image =
        sample.add("images", {{"bufferView", sample.view(bytes)}, {"mimeType", "image/png"}});
    return sample.add("textures", {{"source", image}});
  };
  const int diffuse = texture({188, 64, 64, 255}, {0, 0, 0, 128});
  const int gloss = texture({56, 56, 56, 128}, {255, 226, 157, 204});
  Json material;
  material["extensions"]["KHR_materials_pbrSpecularGlossiness"] = {
      {"diffuseTexture", {{"index", diffuse}}},
      {"specularGlossinessTexture", {{"index", gloss}}},
      {"glossinessFactor", 0.5}};
  // A fallback for other readers, which must not be used.
  material["pbrMetallicRoughness"]["metallicRoughnessTexture"] = {{"index", diffuse}};
  sample.json["materials"] = {material, material};
  glint::Scene scene = sample.load();
  EXPECT_THAT(scene.warnings, IsEmpty());
  EXPECT_EQ(scene.images.size(), 4u);  // the file's, and two derived ones for both materials
  const glint::Material& m = scene.materials.at(0);
  using glint::textured::exponent, glint::textured::metalness, glint::textured::specular;
  EXPECT_EQ(m.textured,
            unsigned(specular | exponent | metalness) | unsigned(glint::textured::diffuse));
  ASSERT_TRUE(m.colorTexture && m.parameterTextures.metallicRoughness &&
              m.parameterTextures.specular);
  EXPECT_EQ(m.parameterTextures.specular->image, m.parameterTextures.metallicRoughness->image);

  glint::DecodedImages images = glint::decodeImages(scene, {});
  const auto texels = [&](const glint::Texture& of) {
    const std::vector<std::uint8_t>& v = images.at(of.image).image.values;
    return std::vector<int>(v.begin(), v.end());
  };
  EXPECT_THAT(texels(*m.colorTexture), testing::ElementsAre(188, 64, 64, 255, 255, 226, 157, 128));
  // Roughness 1 - 0.5 x 128 / 255 and 1 - 0.5 x 204 / 255; code 56 is 0.0395, just below a metal.
  const std::vector<int> numbers = texels(*m.parameterTextures.metallicRoughness);
  EXPECT_THAT(std::vector<int>(numbers.begin() + 1, numbers.begin() + 4),
              testing::ElementsAre(191, 0, 10));
  EXPECT_THAT(std::vector<int>(numbers.begin() + 5, numbers.begin() + 8),
              testing::ElementsAre(153, 255, 255));

  // An unlit one shows the file's diffuse texture unchanged, and the other one is not read.
  for (Json& each : sample.json["materials"])
    each["extensions"]["KHR_materials_unlit"] = Json::object();
  const glint::Scene unlit = sample.load();
  ASSERT_EQ(unlit.images.size(), 1u);
  EXPECT_FALSE(unlit.images[0].gloss);
  EXPECT_EQ(unlit.materials.at(0).textured, 0u);
}

TEST(GltfAllowed, CamerasOfTheFileShowTheirWholeFrame) {
  Sample sample;
  sample.triangle();
  sample.json["cameras"] = {
      {{"type", "orthographic"},
       {"orthographic", {{"xmag", 2}, {"ymag", 0.5}, {"znear", 0.5}, {"zfar", 3}}}},
      {{"type", "perspective"},
       {"perspective", {{"yfov", 1}, {"aspectRatio", 2}, {"znear", 0.1}}}}};
  for (int i = 0; i < 2; ++i) sample.show({{"camera", i}, {"translation", {0, 0, 2}}});
  const glint::Scene scene = sample.load();
  const glint::Bounds bounds = glint::boundsOf(scene);
  glint::Look look;
  for (const glm::ivec2 size : {glm::ivec2(100, 100), {400, 100}, {800, 100}, {100, 400}}) {
    look.resolution = size;
    look.cameraIndex = 0;
    glint::Camera camera = glint::cameraFor(scene, bounds, look);
    const double aspect = double(size.x) / size.y;
    EXPECT_DOUBLE_EQ(camera.halfHeight, std::max(0.5, 2 / aspect));
    EXPECT_LE(camera.far, 3);
    EXPECT_GE(camera.near, 0.5);
    look.cameraIndex = 1;
    camera = glint::cameraFor(scene, bounds, look);
    EXPECT_NEAR(camera.halfHeight, std::tan(0.5) * std::max(1.0, 2 / aspect), 1e-12);
  }
}

TEST(GltfAllowed, WhatIsNotSeenDoesNotCountForTheView) {
  Sample sample;
  sample.triangle();
  sample.json["materials"] = {
      {{"alphaMode", "BLEND"}, {"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, 0}}}}}};
  const double radius = glint::boundsOf(sample.load()).radius;
  sample.show({{"mesh", 0}, {"scale", {0, 0, 0}}, {"translation", {50, 0, 0}}});
  EXPECT_EQ(glint::boundsOf(sample.load()).radius, radius);
  sample.triangle()["material"] = 0;
  sample.json["nodes"].back()["translation"] = {0, 50, 0};
  EXPECT_EQ(glint::boundsOf(sample.load()).radius, radius);
  sample.json["materials"][0]["alphaMode"] = "OPAQUE";  // in this mode alpha is ignored
  EXPECT_GT(glint::boundsOf(sample.load()).radius, 10);
}

}  // namespace gltf_allowed_test
