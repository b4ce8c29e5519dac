// Materials, textures and images.
#include <gmock/gmock.h>

#include "gltf_sample.h"

namespace gltf_material_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using Json = Sample::Json;

const std::string png = "\x89PNG\r\n\x1a\n and the rest";
const std::string jpeg = "\xff\xd8\xff and the rest\xff\xd9";

std::string textOf(const glint::EncodedImage& image) {
  return {reinterpret_cast<const char*>(image.bytes.data()), image.bytes.size()};
}

/// A triangle with a material and two sets of texture coordinates.
struct MaterialSample : Sample {
  MaterialSample() {
    Json& primitive = triangle();
    primitive["material"] = 0;
    primitive["attributes"]["TEXCOORD_0"] = accessor<float>("VEC2", {0, 0, 1, 0, 0, 1});
    primitive["attributes"]["TEXCOORD_1"] = accessor<float>("VEC2", {5, 5, 6, 5, 5, 6});
    json["materials"] = {{{"name", "Paint"}}};
  }
  Json& material() { return json["materials"][0]; }
  glint::Material loaded() { return load().materials.at(0); }
};

TEST(GltfMaterial, DefaultStandsLast) {
  MaterialSample sample;
  sample.primitive({{"attributes", {{"POSITION", 0}}}});
  const glint::Scene scene = sample.load();
  ASSERT_EQ(scene.materials.size(), 2u);
  EXPECT_EQ(scene.materials[0].name, "Paint");
  EXPECT_EQ(scene.meshes.at(0).material, 0);
  EXPECT_EQ(scene.meshes.at(1).material, 1);
}

TEST(GltfMaterial, FactorsAndExtensions) {
  MaterialSample sample;
  sample.material() = {{"pbrMetallicRoughness",
                        {{"baseColorFactor", {0.1, 0.2, 0.3, 0.4}}, {"metallicFactor", 0.25}}},
                       {"emissiveFactor", {1, 0.5, 0}},
                       {"alphaMode", "MASK"},
                       {"alphaCutoff", 0.7},
                       {"doubleSided", true},
                       {"extensions",
                        {{"KHR_materials_unlit", Json::object()},
                         {"KHR_materials_ior", {{"ior", 1.33}}},
                         {"KHR_materials_transmission", {{"transmissionFactor", 0.9}}},
                         {"KHR_materials_emissive_strength", {{"emissiveStrength", 4}}}}}};
  const glint::Material material = sample.loaded();
  EXPECT_EQ(material.shading.color, glm::dvec3(0.1, 0.2, 0.3));
  EXPECT_EQ(material.alpha, 0.4);
  EXPECT_EQ(material.shading.metalness, 0.25);
  EXPECT_EQ(material.shading.ior, 1.33);
  EXPECT_EQ(material.emission, glm::dvec3(4, 2, 0));
  EXPECT_EQ(material.shading.transmission, 0.9);
  EXPECT_EQ(material.alphaMode, glint::AlphaMode::mask);
  EXPECT_EQ(material.alphaCutoff, 0.7);
  EXPECT_TRUE(material.doubleSided);
  EXPECT_TRUE(material.unlit);
}

TEST(GltfMaterial, UnknownAlphaModeIsOpaque) {
  MaterialSample sample;
  sample.material()["alphaMode"] = "GLASS\n";
  const glint::Scene scene = sample.load();
  EXPECT_EQ(scene.materials[0].alphaMode, glint::AlphaMode::opaque);
  EXPECT_THAT(scene.warnings, ElementsAre(HasSubstr("unknown alphaMode \"GLASS\\n\"")));
}

// Parameters come from the factors; bits record which ones the textures give instead, unless the
// user sets them.
TEST(GltfMaterial, TexturesOfNumbers) {
  MaterialSample sample;
  sample.json["images"] = {{{"uri", std::string("data:image/png;base64,iVBORw0KGgo=")}}};
  sample.json["textures"] = {{{"source", 0}}};
  Json& material = sample.material();
  material["pbrMetallicRoughness"] = {{"metallicRoughnessTexture", {{"index", 0}}},
                                      {"metallicFactor", 0.5},
                                      {"roughnessFactor", 0.5}};
  material["occlusionTexture"] = {{"index", 0}, {"strength", 0.25}};
  material["extensions"] = {
      {"KHR_materials_specular", {{"specularFactor", 0.5}, {"specularTexture", {{"index", 0}}}}},
      {"KHR_materials_transmission",
       {{"transmissionFactor", 0.5}, {"transmissionTexture", {{"index", 0}}}}}};
  using namespace glint::textured;
  const glint::Material all = sample.loaded();
  EXPECT_EQ(all.textured, ambient | diffuse | specular | exponent | metalness | transmission);
  EXPECT_EQ(all.shading.metalness, 0.5);
  EXPECT_NEAR(all.shading.exponent, 0.5 * 16 - 0.5, 1e-12);
  EXPECT_EQ(all.shading.transmission, 0.5);
  EXPECT_EQ(all.parameterTextures.occlusionStrength, 0.25);
  EXPECT_NEAR(all.parameterTextures.reflectance, 0.02, 1e-12);  // half of ((1.5 - 1) / 2.5)^2
  // A factor may make a texture irrelevant.
  material["pbrMetallicRoughness"]["metallicFactor"] = 0;
  material["occlusionTexture"]["strength"] = 0;
  material["extensions"]["KHR_materials_transmission"]["transmissionFactor"] = 0;
  EXPECT_EQ(sample.loaded().textured, specular | exponent);
  material["extras"]["glint"] = {{"exponent", 40}};
  EXPECT_EQ(sample.loaded().textured, unsigned(specular));
  EXPECT_EQ(sample.loaded().shading.exponent, 40);
}

TEST(GltfMaterial, ExtrasWin) {
  MaterialSample sample;
  sample.material()["extras"]["glint"] = {{"ambient", 0.5},    {"diffuse", 0.8}, {"specular", 0.25},
                                          {"exponent", 40},    {"metalness", 1}, {"ior", 2},
                                          {"color", {1, 2, 3}}};
  const glint::ShadingParameters shading = sample.loaded().shading;
  EXPECT_EQ(shading.ambient, 0.5);
  EXPECT_EQ(shading.diffuse, 0.8);
  EXPECT_EQ(shading.specular, 0.25);
  EXPECT_EQ(shading.exponent, 40);
  EXPECT_EQ(shading.metalness, 1);
  EXPECT_EQ(shading.ior, 2);
  EXPECT_EQ(shading.color, glm::dvec3(1, 2, 3));
}

TEST(GltfMaterial, FaultyExtrasAreToldAndMended) {
  MaterialSample sample;
  const glint::ShadingParameters before = sample.loaded().shading;
  Json& extras = sample.material()["extras"];
  extras["glint"] = {{"ambient", "much"}, {"exponent", 5000000000u}, {"metalness", -2}, {"ior", 0},
                     {"gloss", 1},        {"color", {1, 2}}};
  const glint::Scene scene = sample.load();
  const glint::ShadingParameters& shading = scene.materials[0].shading;
  EXPECT_EQ(shading.ambient, before.ambient);
  EXPECT_EQ(shading.exponent, 1e6);
  EXPECT_EQ(shading.metalness, 0);
  EXPECT_EQ(shading.ior, 1e-3);
  EXPECT_EQ(shading.color, before.color);
  EXPECT_THAT(scene.warnings,
              ElementsAre(HasSubstr("materials[0] extras.glint.ambient is not a number"),
                          HasSubstr(".color is not three numbers"),
                          HasSubstr(".exponent is out of range, 1000000.0 is used"),
                          HasSubstr(".gloss is not known"), HasSubstr(".ior is out of range"),
                          HasSubstr(".metalness is out of range")));
  extras["glint"] = 5;
  EXPECT_THAT(sample.load().warnings, ElementsAre(HasSubstr("is not an object")));
  extras = "anything";
  EXPECT_THAT(sample.load().warnings, IsEmpty());
}

TEST(GltfTexture, OnlyShownImagesAndReadCoordinatesAreKept) {
  MaterialSample sample;
  sample.writeText(png, "a b.png");
  const int view = sample.view(std::vector<char>(jpeg.begin(), jpeg.end()));
  sample.json["images"] = {{{"uri", "unused.png"}},
                           {{"uri", "a%20b.png"}},
                           {{"bufferView", view}, {"mimeType", "image/jpeg"}}};
  sample.json["samplers"] = {
      {{"magFilter", 9728}, {"minFilter", 9985}, {"wrapS", 33071}, {"wrapT", 33648}}};
  sample.json["textures"] = {{{"source", 2}, {"sampler", 0}}, {{"source", 1}}, {{"source", 0}}};
  sample.material() = {
      {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}, {"texCoord", 1}}}}},
      {"emissiveFactor", {1, 1, 1}},
      {"emissiveTexture", {{"index", 1}, {"texCoord", 1}}},
      {"extensions", {{"KHR_materials_clearcoat", {{"clearcoatTexture", {{"index", 2}}}}}}}};
  for (const auto& path : {sample.writeGltf(), sample.writeGlb()}) {
    const glint::Scene scene = glint::loadGltf(path);
    EXPECT_THAT(scene.warnings, IsEmpty());
    ASSERT_EQ(scene.images.size(), 2u);
    const glint::Material& material = scene.materials.at(0);
    ASSERT_TRUE(material.colorTexture && material.emissionTexture);
    EXPECT_EQ(textOf(scene.images.at(static_cast<std::size_t>(material.colorTexture->image))),
              jpeg);
    EXPECT_EQ(textOf(scene.images.at(static_cast<std::size_t>(material.emissionTexture->image))),
              png);
    const glint::Sampler& sampler = material.colorTexture->sampler;
    EXPECT_EQ(sampler.magnify, glint::Filter::nearest);
    EXPECT_EQ(sampler.minify, glint::Filter::linear);
    EXPECT_EQ(sampler.mip, glint::MipFilter::nearest);
    EXPECT_EQ(sampler.wrapS, glint::Wrap::clampToEdge);
    EXPECT_EQ(sampler.wrapT, glint::Wrap::mirroredRepeat);
    EXPECT_EQ(material.emissionTexture->sampler.mip, glint::MipFilter::linear);
    EXPECT_EQ(material.emissionTexture->sampler.wrapS, glint::Wrap::repeat);
    const auto& texcoords = scene.meshes.at(0).texcoords;
    ASSERT_EQ(texcoords.size(), 2u);
    EXPECT_THAT(texcoords[0], IsEmpty());
    EXPECT_EQ(texcoords[1].at(0), glm::vec2(5, 5));
  }
}

TEST(GltfTexture, OneImageIsKeptOnce) {
  MaterialSample sample;
  sample.json["images"] = {{{"uri", "data:image/png;base64,iVBORw0KGgo="}}};
  sample.json["textures"] = {{{"source", 0}}, {{"source", 0}}};
  for (const int index : {0, 1}) {
    sample.json["materials"][static_cast<std::size_t>(index)] = {
        {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", index}}}}}};
  }
  const glint::Scene scene = sample.load();
  EXPECT_EQ(scene.images.size(), 1u);
  EXPECT_TRUE(scene.materials.at(1).colorTexture);
}

TEST(GltfTexture, UnusableImagesLeaveTheMaterialWithoutTexture) {
  MaterialSample sample;
  sample.json["textures"] = {{{"source", 0}}};
  sample.material()["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 0;
  const auto warningOf = [&](const Json& image) {
    sample.json["images"] = {image};
    const glint::Scene scene = sample.load();
    EXPECT_FALSE(scene.materials.at(0).colorTexture);
    EXPECT_THAT(scene.images, IsEmpty());
    EXPECT_EQ(scene.warnings.size(), 1u);
    return scene.warnings.empty() ? std::string() : scene.warnings[0];
  };
  sample.writeText("\xabKTX 20\xbb\r\n\x1a\n", "a.ktx2");
  EXPECT_EQ(warningOf({{"uri", "gone.png"}}),
            "the image gone.png does not exist, drawn without it");
  EXPECT_THAT(warningOf({{"uri", "a.ktx2"}}), HasSubstr("is neither PNG nor JPEG (KTX)"));
  EXPECT_THAT(warningOf({{"uri", "/dev/zero"}}), HasSubstr("is not a regular file"));
  EXPECT_THAT(warningOf({{"uri", "data:image/png;base64,!!"}}), HasSubstr("base64 is damaged"));
  EXPECT_THAT(warningOf(Json::object()), HasSubstr("neither a bufferView nor a uri"));
  sample.json["textures"] = {{{"extensions", {{"KHR_texture_basisu", {{"source", 0}}}}}}};
  EXPECT_THAT(
      warningOf({{"uri", "a.ktx2"}}),
      HasSubstr("textures[0] is compressed (KHR_texture_basisu), which is not read, and has"));
}

TEST(GltfTexture, ReferencesAreChecked) {
  MaterialSample sample;
  sample.json["images"] = {{{"uri", "gone.png"}}};
  sample.json["textures"] = {{{"source", 0}, {"sampler", 0}}};
  Json& info = sample.material()["pbrMetallicRoughness"]["baseColorTexture"];
  info["index"] = 5;
  EXPECT_THAT(sample.error(), HasSubstr("baseColorTexture.index must be a whole number"));
  info["index"] = 0;
  EXPECT_THAT(sample.error(), HasSubstr("textures[0].sampler refers to something"));
  sample.json["textures"] = {{{"source", 1}}};
  EXPECT_THAT(sample.error(), HasSubstr("textures[0].source must be a whole number"));
  sample.json["textures"] = {{{"source", 0}}};
  sample.json["images"] = {{{"bufferView", 77}}};
  EXPECT_THAT(sample.error(), HasSubstr("images[0].bufferView must be"));
}

TEST(GltfTexture, MeshWithoutTheCoordinatesIsDrawnWithout) {
  MaterialSample sample;
  sample.json["images"] = {{{"uri", "data:image/png;base64,iVBORw0KGgo="}}};
  sample.json["textures"] = {{{"source", 0}}};
  Json& info = sample.material()["pbrMetallicRoughness"]["baseColorTexture"];
  info = {{"index", 0}, {"texCoord", 3}};
  EXPECT_THAT(sample.load().warnings, ElementsAre(HasSubstr("has no TEXCOORD_3")));
  info["texCoord"] = 2000000000;
  EXPECT_THAT(sample.load().warnings, ElementsAre(HasSubstr("beyond 15")));
}

}  // namespace gltf_material_test
