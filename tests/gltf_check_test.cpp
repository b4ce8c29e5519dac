// Structure: contradictory files are refused before anything reads them.
#include <gmock/gmock.h>

#include "gltf_sample.h"

namespace gltf_check_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using Json = Sample::Json;

/// Expects that a valid document is refused after the JSON at a path is replaced.
void expectRefused(const std::string& pointer, const Json& value, const std::string& message) {
  SCOPED_TRACE(pointer + " = " + value.dump());
  Sample sample;
  Json& primitive = sample.triangle();  // accessor and view 0
  primitive["indices"] = sample.accessor<std::uint16_t>("SCALAR", {0, 1, 2});
  sample.json["materials"] = {{{"name", "M"}}};
  sample.json["scene"] = 0;
  ASSERT_EQ(sample.error(), "");
  sample.json[Json::json_pointer(pointer)] = value;
  EXPECT_THAT(sample.error(), HasSubstr(message));
}

TEST(GltfCheck, TypesAreChecked) {
  for (const char* section : {"/meshes", "/nodes", "/accessors", "/bufferViews", "/materials",
                              "/scenes", "/skins", "/asset", "/extensionsRequired"}) {
    expectRefused(section, "text", std::string(section).substr(1) + " must be");
    expectRefused(section, nullptr, std::string(section).substr(1) + " must be");
  }
  expectRefused("/meshes/0", 5, "meshes[0] must be an object, not 5");
  expectRefused("/meshes/0/primitives", Json::object(), "meshes[0].primitives must be an array");
  expectRefused("/meshes/0/primitives/0/attributes", Json::array(), "must be an object");
  expectRefused("/nodes/0", "x", "nodes[0] must be an object");
  expectRefused("/nodes/0/matrix", {1, 2, 3}, "an array of 16 numbers");
  expectRefused("/nodes/0/translation", {1, 2, "3"}, "an array of 3 numbers");
  expectRefused("/nodes/0/children", 0, "nodes[0].children must be an array");
  expectRefused("/scene", "hello", "scene must be a whole number from 0 to 0, not \"hello\"");
  expectRefused("/materials/0/pbrMetallicRoughness", 1, "must be an object");
  expectRefused("/materials/0/doubleSided", 1, "materials[0].doubleSided must be true or false");
  expectRefused("/accessors/0/type", 5, "accessors[0].type must be text");
}

TEST(GltfCheck, IndicesAreChecked) {
  for (const Json& bad : {Json(7), Json(-1), Json(1.5), Json(4294967296), Json(1e300)}) {
    expectRefused("/scene", bad, "scene must be");
    expectRefused("/scenes/0/nodes/0", bad, "scenes[0].nodes[0] must be");
    expectRefused("/nodes/0/mesh", bad, "nodes[0].mesh must be");
    expectRefused("/nodes/0/children", Json::array({bad}), "nodes[0].children[0] must be");
    expectRefused("/meshes/0/primitives/0/indices", bad, "primitives[0].indices must be");
    expectRefused("/meshes/0/primitives/0/material", bad, "primitives[0].material must be");
    expectRefused("/meshes/0/primitives/0/mode", bad, "primitives[0].mode must be");
    expectRefused("/meshes/0/primitives/0/attributes/POSITION", bad, "POSITION must be");
    expectRefused("/meshes/0/primitives/0/targets", {{{"POSITION", bad}}}, "POSITION must be");
    expectRefused("/accessors/0/bufferView", bad, "accessors[0].bufferView must be");
    expectRefused("/bufferViews/0/buffer", bad, "bufferViews[0].buffer must be");
  }
  expectRefused("/nodes/0/skin", 0, "refers to something that the file does not have");
  expectRefused("/nodes/0/camera", 0, "refers to something that the file does not have");
}

TEST(GltfCheck, AttributeNamesWithAZeroByteAreCheckedToo) {
  Sample sample;
  sample.triangle()["attributes"][std::string("POSITION\0", 9)] = 99999;
  EXPECT_THAT(sample.error(), HasSubstr("must be a whole number from 0 to 0, not 99999"));
}

TEST(GltfCheck, WholeNumbersMayBeWrittenWithAPoint) {
  Sample sample;
  sample.triangle();
  sample.json["accessors"][0]["count"] = 3.0;
  sample.json["nodes"][0]["mesh"] = 0.0;
  EXPECT_EQ(sample.load().instances.size(), 1u);
}

TEST(GltfCheck, BytesAreChecked) {
  expectRefused("/accessors/0/count", 4, "accessors[0] extends past the end of its buffer view");
  expectRefused("/accessors/0/count", 4294967295, "extends past the end");
  expectRefused("/accessors/0/count", -1, "accessors[0].count must be");
  expectRefused("/accessors/0/byteOffset", 4, "extends past the end");
  expectRefused("/accessors/0/byteOffset", 18446744073709551615ull, "byteOffset must be");
  expectRefused("/accessors/0/type", "VEC5", "accessors[0].type is not defined in glTF 2.0");
  expectRefused("/accessors/0/componentType", 5124, "componentType is not defined in glTF 2.0");
  expectRefused("/accessors/0/componentType", 5130, "componentType is not defined in glTF 2.0");
  expectRefused("/bufferViews/0/byteLength", 1000, "bufferViews[0] ends at byte 1000");
  expectRefused("/bufferViews/0/byteOffset", 1e15, "byteOffset must be");
  expectRefused("/bufferViews/0/byteStride", 8, "accessors[0] has elements of 12 bytes");
  expectRefused("/bufferViews/0/byteStride", 14, "must be a multiple of 4");
  expectRefused("/bufferViews/0/byteStride", 256, "byteStride must be");
  expectRefused("/accessors/1/type", "VEC2", "extends past the end");
  expectRefused("/accessors/1/componentType", 5120, "is not of unsigned integers");
  expectRefused("/accessors/0/type", "VEC2", "POSITION must have 3 components per vertex, not 2");
}

TEST(GltfCheck, BufferShorterThanToldIsRefused) {
  Sample sample;
  sample.triangle();
  sample.writeGltf();
  sample.buffers = {{{"byteLength", 1000}, {"uri", "sample.bin"}}};
  EXPECT_THAT(sample.error(), StartsWith("buffers[0] declares 1000 bytes but has 36"));
}

TEST(GltfCheck, SparseAccessorsAreChecked) {
  const Json sound = {{"count", 1},
                      {"indices", {{"bufferView", 1}, {"componentType", 5123}}},
                      {"values", {{"bufferView", 0}}}};
  const auto refuse = [&](const std::string& pointer, const Json& value, const char* message) {
    Json sparse = sound;
    sparse[Json::json_pointer(pointer)] = value;
    expectRefused("/accessors/0/sparse", sparse, message);
  };
  refuse("/count", 4, "sparse.count must be a whole number from 0 to 3");
  refuse("/indices", 1, "sparse.indices must be an object");
  refuse("/indices/componentType", 5126, "must be 5121, 5123 or 5125");
  refuse("/indices/bufferView", 9, "sparse.indices.bufferView");
  refuse("/indices/byteOffset", 5, "extends past the end");
  refuse("/values/byteOffset", 30, "extends past the end");
}

TEST(GltfCheck, NodesAreTrees) {
  Sample sample;
  sample.triangle();
  sample.json["nodes"] = {{{"mesh", 0}, {"children", {1}}}, {{"children", {0}}}};
  EXPECT_THAT(sample.error(), HasSubstr("is its own ancestor"));
  sample.json["nodes"] = {{{"mesh", 0}, {"children", {0}}}};
  EXPECT_THAT(sample.error(), HasSubstr("is its own ancestor"));
  sample.json["nodes"] = {{{"children", {2}}}, {{"children", {2}}}, {{"mesh", 0}}};
  EXPECT_THAT(sample.error(), HasSubstr("already a child of node 0"));
  sample.json["nodes"] = {{{"children", {1, 1}}}, {{"mesh", 0}}};
  EXPECT_THAT(sample.error(), HasSubstr("already a child of node 0"));
}

TEST(GltfCheck, DeepChainOfNodesLoads) {
  Sample sample;
  sample.triangle();
  Json& nodes = sample.json["nodes"] = Json::array();
  for (int i = 0; i < 100000; ++i) {
    nodes.push_back({{"children", {i + 1}}, {"translation", {1, 0, 0}}});
  }
  nodes.push_back({{"mesh", 0}});
  const glint::Scene scene = sample.load();
  EXPECT_EQ(scene.instances.at(0).world[3].x, 100000);
}

TEST(GltfCheck, VersionsAreChecked) {
  Sample sample;
  sample.triangle();
  for (const char* version : {"1.0", "3.0", "", "two", "2", "2.0.1", "-2.0"}) {
    sample.json["asset"] = {{"version", version}};
    EXPECT_THAT(sample.error(), HasSubstr("only 2.x is supported")) << version;
  }
  sample.json["asset"] = {{"version", "2.1"}};
  EXPECT_EQ(sample.error(), "");
  sample.json["asset"] = {{"version", "2.1"}, {"minVersion", "2.1"}};
  EXPECT_THAT(sample.error(), HasSubstr("needs glTF version \"2.1\""));
  sample.json["asset"] = {{"version", 2.0}};
  EXPECT_THAT(sample.error(), HasSubstr("asset.version must be text"));
}

TEST(GltfCheck, Extensions) {
  Sample sample;
  sample.triangle();
  Sample::Json& sheen = sample.json["materials"][0]["extensions"]["KHR_materials_sheen"];
  sheen["sheenColorFactor"] = {0, 0, 0};  // no visible effect
  sample.json["extensionsUsed"] = {"KHR_materials_ior", "KHR_materials_sheen", "KHR_x", "KHR_x"};
  EXPECT_THAT(sample.load().warnings, ElementsAre(HasSubstr("KHR_x")));
  sheen["sheenColorFactor"] = {0, 0, 1};
  EXPECT_THAT(sample.load().warnings,
              ElementsAre(HasSubstr("KHR_materials_sheen"), HasSubstr("KHR_x")));
  sample.json["extensionsRequired"] = {"KHR_mesh_quantization", "KHR_materials_sheen"};
  EXPECT_EQ(sample.error(),
            "requires the extension KHR_materials_sheen, which is not supported by this "
            "version: export it without that extension");
}

TEST(GltfCheck, SmallFileMayNotUnfoldToAHugeModel) {
  Sample sample;
  sample.triangle();
  sample.json["accessors"][0].erase("bufferView");
  sample.json["accessors"][0]["count"] = 4000000000u;
  EXPECT_THAT(sample.error(), HasSubstr("expands to far more vertices"));

  // A million vertices of zeros, drawn repeatedly with different weights.
  sample.json["accessors"][0]["count"] = 3000000;
  for (int i = 0; i < 1000; ++i) {
    sample.json["nodes"].push_back({{"mesh", 0}, {"weights", {i}}});
    sample.json["scenes"][0]["nodes"].push_back(i + 1);
  }
  EXPECT_THAT(sample.error(), HasSubstr("expands to far more vertices"));
}

TEST(GltfCheck, NothingToDraw) {
  Sample sample;
  EXPECT_THAT(sample.load().warnings, ElementsAre("nothing to draw"));
  sample.json["scene"] = 0;  // there are no scenes
  EXPECT_THAT(sample.load().warnings, ElementsAre("nothing to draw"));
  EXPECT_EQ(sample.load().materials.size(), 1u);
}

TEST(GltfCheck, WarningsAreCounted) {
  Sample sample;
  for (int i = 0; i < 150; ++i) sample.primitive({{"attributes", Json::object()}});
  const glint::Scene scene = sample.load();
  ASSERT_EQ(scene.warnings.size(), 101u);
  EXPECT_EQ(scene.warnings.back(), "and 51 more warnings");  // 150 and "nothing to draw"
}

}  // namespace gltf_check_test
