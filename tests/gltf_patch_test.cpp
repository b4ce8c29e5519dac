#include "glint/gltf/patch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "glint/image/error.h"
#include "glint/image/file.h"
#include "glint/scene/material_parameters.h"
#include "glint/shading/pbr_conversion.h"
#include "gltf_sample.h"

namespace glint {
namespace gltf_patch_test {

using Json = nlohmann::ordered_json;
using testing::HasSubstr;

std::vector<std::byte> bytesOf(const std::string& text) {
  const auto* data = reinterpret_cast<const std::byte*>(text.data());
  return {data, data + text.size()};
}

std::string textOf(const std::vector<std::byte>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::string patched(const std::string& text, const std::vector<MaterialPatch>& patches) {
  return textOf(patchGltf(bytesOf(text), patches, "model.gltf"));
}

// Numbers in unusual notation, unknown extensions, odd white space, unordered keys.
const std::string oddFile = R"({
  "extensions": {"VENDOR_x": {"big": 123456789012345678901234567890, "tiny": 1E-007}},
  "asset" : {"version":"2.0","extras":{"id":18446744073709551615}},
  "materials": [
    {"name": "body \"A\" }", "extras": {"mine": [1.50, {"glint": 3}]}, "alphaCutoff": 0.50},
    {	"name": "lid" }
  ],
  "meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}]
}
)";

TEST(PatchGltf, LeavesEverythingElseAsItStands) {
  ShadingParameters values;
  values.exponent = 40;
  values.color = {0.8, 0.2, 0.1};
  const std::string out = patched(oddFile, {{0, values}});
  // Without the insertions, the text is identical to the old one.
  std::string rest = out;
  const auto cut = [&](const std::string& piece) {
    const auto at = rest.find(piece);
    ASSERT_NE(at, std::string::npos) << piece << "\nin\n" << out;
    rest.erase(at, piece.size());
  };
  cut(R"(, "glint": {"ambient": 1, "diffuse": 1, "specular": 0, "exponent": 40, "metalness": 0, )"
      R"("ior": 1.5, "transmission": 0, "color": [0.8, 0.2, 0.1]})");
  const Json json = Json::parse(out);
  const double roughness = json["materials"][0]["pbrMetallicRoughness"]["roughnessFactor"];
  EXPECT_NEAR(exponentFromRoughness(roughness), 40, 1e-9);
  EXPECT_EQ(json["materials"][0]["pbrMetallicRoughness"]["metallicFactor"], 0);
  EXPECT_EQ(json["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"],
            Json::array({0.8, 0.2, 0.1, 1}));
  const auto begin = rest.find(", \"pbrMetallicRoughness\"");
  ASSERT_NE(begin, std::string::npos);
  rest.erase(begin, rest.find('}', begin) + 1 - begin);
  EXPECT_EQ(rest, oddFile);
}

/// A material with textures: 1 metallic-roughness or specular-glossiness, 2 specular, 4 occlusion.
Sample::Json materialWith(unsigned textures, bool isGloss) {
  const Sample::Json texture{{"index", 0}};
  Sample::Json m{{"pbrMetallicRoughness", {{"metallicFactor", 0.3}, {"roughnessFactor", 0.4}}}};
  if (textures & 1) m["pbrMetallicRoughness"]["metallicRoughnessTexture"] = texture;
  if (textures & 2) m["extensions"]["KHR_materials_specular"]["specularTexture"] = texture;
  if (textures & 4) m["occlusionTexture"] = texture;
  if (isGloss) {
    Sample::Json& gloss = m["extensions"]["KHR_materials_pbrSpecularGlossiness"];
    gloss = {{"specularFactor", {0.5, 0.3, 0.2}}, {"glossinessFactor", 0.6}};
    if (textures & 1) gloss["specularGlossinessTexture"] = texture;
  }
  return m;
}

// Whatever textures give, and whichever numbers are edited, the file has the material that the
// edits show, with and without a normalization.
TEST(PatchGltf, TheFileHasTheEditedMaterial) {
  const std::vector<MaterialParameter> parameters(materialParameters().begin(),
                                                  materialParameters().end());
  Sample sample;
  const std::size_t kinds = 16;
  for (unsigned kind = 0; kind < kinds; ++kind)
    sample.add("materials", materialWith(kind % 8, kind >= 8));
  sample.json["materials"][0]["extras"]["glint"]["exponent"] = 30;
  sample.json["materials"][8]["extras"]["glint"]["specular"] = 0.3;
  sample.json["images"] = {{{"uri", "data:image/png;base64,iVBORw0KGgo="}}};
  sample.json["textures"] = {{{"source", 0}}};
  const auto path = sample.writeGltf();
  const Scene before = loadGltf(path);
  for (unsigned edits = 1; edits < 1u << parameters.size(); ++edits) {
    Look edited, none;
    for (std::size_t k = 0; k < parameters.size(); ++k)
      if (edits >> k & 1) edited.material[""].*parameters[k].edit = 0.2 + 0.1 * double(k);
    std::vector<MaterialPatch> patches;
    for (std::size_t i = 0; i < kinds; ++i)
      patches.push_back(patchOf(i, withEdits(before.materials[i], edited)));
    const auto bytes = patchGltf(readFile(path.string()), patches, "a");
    const Scene after = loadGltf(sample.writeText(textOf(bytes), "copy.gltf"));
    for (std::size_t i = 0; i < kinds; ++i)
      for (const Normalization normalization : {Normalization::none, Normalization::simple}) {
        SCOPED_TRACE(testing::Message() << "material " << i << ", edits " << edits);
        edited.normalization = none.normalization = normalization;
        const Material as = editedMaterial(before.materials[i], edited);
        const Material is = editedMaterial(after.materials[i], none);
        for (const MaterialParameter& p : parameters)
          ASSERT_EQ(is.shading.*p.value, as.shading.*p.value) << p.name;
        ASSERT_EQ(is.shading.color, as.shading.color);
        ASSERT_EQ(is.textured, as.textured);
        const unsigned converted =
            textured::diffuse | textured::specular | textured::exponent | textured::metalness;
        if (!(as.textured & converted)) continue;
        ASSERT_EQ(is.parameterTextures.metallic, as.parameterTextures.metallic);
        ASSERT_EQ(is.parameterTextures.roughness, as.parameterTextures.roughness);
        if (as.textured & textured::specular)
          ASSERT_EQ(is.parameterTextures.reflectance, as.parameterTextures.reflectance);
      }
  }
}

TEST(PatchGltf, ASecondPatchReplacesTheFirst) {
  ShadingParameters values;
  values.exponent = 40;
  const std::string once = patched(oddFile, {{1, values}});
  values.exponent = 7;
  const std::string twice = patched(once, {{1, values}});
  EXPECT_THAT(twice, HasSubstr("\"exponent\": 7"));
  EXPECT_THAT(twice, testing::Not(HasSubstr("\"exponent\": 40")));
  EXPECT_EQ(patched(twice, {{1, values}}), twice);
}

TEST(PatchGltf, KeepsTheAlphaAndWhatTexturesVary) {
  const std::string file = R"({"asset":{"version":"2.0"},"materials":[{"pbrMetallicRoughness":)"
                           R"({"baseColorFactor":[1,1,1,0.5],"metallicFactor":0.3,)"
                           R"("metallicRoughnessTexture":{"index":0}}}]})";
  ShadingParameters values;
  values.color = {0.5, 0.5, 0.5};
  values.metalness = 1;
  const Json pbr =
      Json::parse(patched(file, {{0, values}}))["materials"][0]["pbrMetallicRoughness"];
  EXPECT_EQ(pbr["baseColorFactor"], Json::array({0.5, 0.5, 0.5, 0.5}));
  EXPECT_EQ(pbr["metallicFactor"], 0.3);
  EXPECT_FALSE(pbr.contains("roughnessFactor"));
}

TEST(PatchGltf, AnIndexOfRefractionNeedsItsExtension) {
  ShadingParameters values;
  values.ior = 1.33;
  const std::string file = R"({"asset":{"version":"2.0"},"materials":[{}]})";
  const Json json = Json::parse(patched(file, {{0, values}}));
  EXPECT_EQ(json["materials"][0]["extensions"]["KHR_materials_ior"]["ior"], 1.33);
  EXPECT_EQ(json["extensionsUsed"], Json::array({"KHR_materials_ior"}));
}

TEST(PatchGltf, TheDefaultMaterialBecomesOneOfTheFile) {
  const std::string file =
      R"({"asset":{"version":"2.0"},"meshes":[{"primitives":[{"attributes":{"POSITION":0}},)"
      R"({"attributes":{"POSITION":1},"material":0}]}],"materials":[{"name":"a"}]})";
  ShadingParameters values;
  values.exponent = 3;
  const Json json = Json::parse(patched(file, {{1, values}}));
  ASSERT_EQ(json["materials"].size(), 2u);
  EXPECT_EQ(json["materials"][1]["extras"]["glint"]["exponent"], 3);
  EXPECT_EQ(json["meshes"][0]["primitives"][0]["material"], 1);
  EXPECT_EQ(json["meshes"][0]["primitives"][1]["material"], 0);
  const std::string bare = R"({"asset":{"version":"2.0"},"meshes":[{"primitives":[{}]}]})";
  EXPECT_EQ(Json::parse(patched(bare, {{0, values}}))["meshes"][0]["primitives"][0]["material"], 0);
}

TEST(PatchGltf, OtherChunksOfAGlbStayAsTheyAre) {
  std::string json = R"({"asset":{"version":"2.0"},"materials":[{"name":"a"}]})";
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const std::string chunks =
      std::string("\x08\0\0\0BIN\0\1\2\3\4\5\6\7\xff", 16) + std::string("\x04\0\0\0WHATdata", 12);
  const auto word = [](std::size_t v) {
    std::string s;
    for (int i = 0; i < 4; ++i) s += char(v >> (8 * i));
    return s;
  };
  const std::string glb = "glTF" + word(2) + word(20 + json.size() + chunks.size()) +
                          word(json.size()) + "JSON" + json + chunks;
  ShadingParameters values;
  values.exponent = 11;
  const std::string out = patched(glb, {{0, values}});
  ASSERT_GT(out.size(), glb.size());
  EXPECT_EQ(out.substr(out.size() - chunks.size()), chunks);
  std::uint32_t length = 0, jsonLength = 0;
  std::memcpy(&length, out.data() + 8, 4);
  std::memcpy(&jsonLength, out.data() + 12, 4);
  EXPECT_EQ(length, out.size());
  EXPECT_EQ(jsonLength % 4, 0u);
  EXPECT_EQ(20 + jsonLength + chunks.size(), out.size());
  EXPECT_EQ(Json::parse(out.substr(20, jsonLength))["materials"][0]["extras"]["glint"]["exponent"],
            11);
}

TEST(PatchGltf, RefusesWhatItDoesNotUnderstand) {
  for (const std::string& text :
       {std::string(), std::string("[]"), std::string("{\"asset\":"), std::string("glTF"),
        std::string("glTF\2\0\0\0\xff\xff\xff\xff\xff\xff\xff\xffJSON{}", 22)}) {
    EXPECT_THROW(patched(text, {}), InputError) << text;
  }
  EXPECT_THROW(patched(R"({"materials":[]})", {{3, {}}}), InputError);
}

TEST(PatchGltf, KnowsWhetherOtherFilesAreNeeded) {
  EXPECT_TRUE(refersToFiles(bytesOf(R"({"buffers":[{"uri":"a.bin"}]})"), "m"));
  EXPECT_FALSE(refersToFiles(bytesOf(R"({"buffers":[{"uri":"data:;base64,AA=="}]})"), "m"));
  EXPECT_FALSE(refersToFiles(bytesOf(R"({"buffers":[{"byteLength":4}]})"), "m"));
}

}  // namespace gltf_patch_test
}  // namespace glint
