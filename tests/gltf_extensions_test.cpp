// How the extensions of a file are treated, and which skins and morph targets it has.
#include "glint/gltf/extensions.h"

#include <gmock/gmock.h>

#include <fstream>
#include <sstream>

#include "glint/image/texture.h"
#include "gltf_sample.h"

namespace glint::gltf_extensions_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using Use = FileExtension::Use;

glint::Scene load(Sample& sample) { return glint::loadGltf(sample.writeGltf()); }

TEST(GltfExtensions, AreReadApproximatedOrIgnored) {
  Sample sample;
  sample.triangle();
  sample.json["extensionsUsed"] = {"KHR_materials_unlit", "KHR_materials_specular",
                                   "KHR_materials_clearcoat", "KHR_materials_unlit", "ACME_a\nb"};
  sample.json["materials"] = {
      {{"extensions", {{"KHR_materials_clearcoat", {{"clearcoatFactor", 1}}}}}}};
  sample.json["extensionsRequired"] = {"KHR_materials_unlit", "KHR_mesh_quantization"};
  const glint::Scene scene = load(sample);
  ASSERT_THAT(scene.extensions, SizeIs(5));
  EXPECT_EQ(scene.extensions[0].name, "KHR_materials_unlit");
  EXPECT_EQ(scene.extensions[0].use, Use::read);
  EXPECT_TRUE(scene.extensions[0].required);
  EXPECT_EQ(scene.extensions[1].use, Use::approximated);
  EXPECT_THAT(scene.extensions[1].note, HasSubstr("strength"));
  EXPECT_FALSE(scene.extensions[1].required);
  EXPECT_EQ(scene.extensions[2].use, Use::ignored);
  EXPECT_EQ(scene.extensions[3].use, Use::ignored);
  EXPECT_EQ(scene.extensions[3].name.find('\n'), std::string::npos);
  EXPECT_EQ(scene.extensions[4].name, "KHR_mesh_quantization");
  // One warning for each that is ignored, from the same table.
  EXPECT_THAT(scene.warnings, ElementsAre(HasSubstr("KHR_materials_clearcoat"), HasSubstr("ACME")));
}

// Extensions without a visible effect are reported only by `info`; files that require metadata
// extensions are drawn.
TEST(GltfExtensions, WhatDoesNotShowIsNotWarnedOf) {
  Sample sample;
  sample.triangle();
  sample.json["extensionsUsed"] = {"KHR_xmp_json_ld", "KHR_materials_sheen",
                                   "KHR_materials_volume"};
  sample.json["extensionsRequired"] = {"KHR_xmp_json_ld"};
  sample.json["materials"] = {{{"extensions",
                                {{"KHR_materials_sheen", {{"sheenColorFactor", {0, 0, 0}}}},
                                 {"KHR_materials_volume", {{"thicknessFactor", 0}}}}}}};
  const glint::Scene scene = load(sample);
  EXPECT_THAT(scene.warnings, IsEmpty());
  for (const FileExtension& each : scene.extensions) EXPECT_EQ(each.use, Use::unseen) << each.name;
  sample.json["materials"][0]["extensions"]["KHR_materials_sheen"]["sheenColorFactor"] = {0, 0.5,
                                                                                          0};
  EXPECT_THAT(load(sample).warnings, ElementsAre(HasSubstr("KHR_materials_sheen")));
}

TEST(GltfExtensions, OnesThatAreIgnoredAreRefusedWhereRequired) {
  for (const char* name : {"KHR_materials_clearcoat", "KHR_materials_sheen"}) {
    Sample sample;
    sample.triangle();
    sample.json["extensionsRequired"] = {name};
    EXPECT_THAT(sample.error(), HasSubstr(std::string("requires the extension ") + name +
                                          ", which is not supported by this version"));
  }
  // Extensions that a build leaves out are refused, with the reason.
  for (const char* name :
       {"KHR_draco_mesh_compression", "EXT_meshopt_compression", "EXT_texture_webp"}) {
    const FileExtension extension = glint::gltf::describeExtension(name);
    Sample sample;
    sample.triangle();
    sample.json["extensionsRequired"] = {name};
    if (extension.use == Use::read) {
      EXPECT_EQ(sample.error(), "");
    } else {
      EXPECT_THAT(sample.error(),
                  HasSubstr(std::string(name) + ", which is left out of this build"));
    }
  }
  EXPECT_EQ(glint::gltf::describeExtension("EXT_texture_webp").use == Use::read,
            glint::canDecodeWebp());
}

TEST(GltfExtensions, ManyNamesTakeNoLongTime) {
  Sample sample;
  sample.triangle();
  Sample::Json names;
  for (int i = 0; i < 100'000; ++i) names.push_back("ACME_" + std::to_string(i));
  sample.json["extensionsUsed"] = names;
  EXPECT_THAT(load(sample).extensions, SizeIs(100'000));
}

TEST(GltfExtensions, DocumentationSaysTheSame) {
  std::ifstream file(GLINT_SOURCE_DIR "/docs/materials.md");
  std::size_t found = 0;
  bool inTable = false;
  for (std::string line; std::getline(file, line);) {
    inTable = inTable ? line.starts_with("|") : line == "| extension | read |";
    if (!inTable || (!line.starts_with("| KHR_") && !line.starts_with("| EXT_"))) continue;
    const std::size_t split = line.find(" | ");
    std::istringstream names(line.substr(2, split - 2));
    for (std::string name; std::getline(names, name, ',');) {
      name.erase(0, name.find_first_not_of(' '));
      const FileExtension extension = glint::gltf::describeExtension(name);
      const bool approximated = line.find("approximated", split) != std::string::npos;
      if (extension.note.find("left out") == std::string::npos) {
        EXPECT_EQ(extension.use, approximated ? Use::approximated : Use::read) << name;
      }
      ++found;
    }
  }
  EXPECT_EQ(found, 16u);
}

TEST(GltfExtensions, SkinsAndMorphTargetsAreListed) {
  const std::string models = GLINT_SOURCE_DIR "/models/";
  const glint::Scene bend = glint::loadGltf(models + "bend.glb");
  ASSERT_THAT(bend.skins, SizeIs(1));
  EXPECT_EQ(bend.skins[0].name, "Rod");
  EXPECT_THAT(bend.skins[0].joints, ElementsAre("Joint 0", "Joint 1", "Joint 2", "Joint 3"));
  EXPECT_THAT(bend.morphs, IsEmpty());
  const glint::Scene morph = glint::loadGltf(models + "morph.glb");
  EXPECT_THAT(morph.skins, IsEmpty());
  ASSERT_THAT(morph.morphs, SizeIs(1));
  EXPECT_EQ(morph.morphs[0].name, "Ball");
  EXPECT_THAT(morph.morphs[0].targets, ElementsAre("Tall", "Cube"));
}

TEST(GltfExtensions, NamesOfTargetsOfAnyFormAreSuffered) {
  for (const char* extras : {"5", "null", R"({"targetNames": 5})", R"({"targetNames": [5, null]})",
                             R"({"targetNames": ["A", "B", "C"]})", R"({"targetNames": []})"}) {
    SCOPED_TRACE(extras);
    Sample sample;
    Sample::Json& primitive = sample.triangle();
    const int accessor = primitive["attributes"]["POSITION"];
    primitive["targets"] = {{{"POSITION", accessor}}, {{"POSITION", accessor}}};
    sample.json["meshes"][0]["extras"] = Sample::Json::parse(extras);
    const glint::Scene scene = load(sample);
    ASSERT_THAT(scene.morphs, SizeIs(1));
    EXPECT_THAT(scene.morphs[0].targets, SizeIs(2));
  }
}

}  // namespace glint::gltf_extensions_test
