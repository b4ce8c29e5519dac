#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "glint/image/error.h"
#include "viewer/materials.h"
#include "viewer/presets.h"

namespace glint::viewer {
namespace viewer_material_test {

Scene twoMaterials() {
  Scene scene;
  scene.materials.resize(3);
  scene.materials[0].name = "body";
  scene.materials[1].name = "lid";
  scene.materials[2].name = "#default";
  scene.meshes.resize(2);
  scene.meshes[0].material = 1;
  scene.meshes[1].material = 0;
  scene.instances = {{0, glm::dmat4(1)}, {1, glm::dmat4(1)}};
  return scene;
}

TEST(Materials, OnlyThoseDrawnAreListed) {
  EXPECT_THAT(drawnMaterials(twoMaterials()), testing::ElementsAre(0, 1));
}

TEST(Materials, AllOfThemStandBelowASingleOne) {
  const Scene scene = twoMaterials();
  Look look;
  look.material[""].exponent = 5;
  look.material["lid"].exponent = 9;
  EXPECT_EQ(effectiveParameters(scene, look, 0).exponent, 5);
  EXPECT_EQ(effectiveParameters(scene, look, 1).exponent, 9);
  EXPECT_EQ(effectiveParameters(scene, look, -1).exponent, 5);
}

TEST(Materials, TextComesBackExactly) {
  ShadingParameters values;
  values.ambient = 1.0 / 3;
  values.exponent = 123456.789;
  values.color = {0.1, 1e-7, 7.25};
  Look look;
  pasteMaterial(look, "lid", materialText(values));
  const ShadingParameters back = effectiveParameters(twoMaterials(), look, 1);
  EXPECT_EQ(back.ambient, values.ambient);
  EXPECT_EQ(back.exponent, values.exponent);
  EXPECT_EQ(back.color, values.color);
}

TEST(Materials, PasteTakesPartsAndOptions) {
  Look look;
  pasteMaterial(look, "lid", R"({"exponent": 12})");
  EXPECT_EQ(look.material["lid"].exponent, 12);
  EXPECT_FALSE(look.material["lid"].ambient.has_value());
  pasteMaterial(look, "lid", R"({"name": "x", "extras": {"glint": {"ior": 2}}})");
  EXPECT_EQ(look.material["lid"].ior, 2);
  pasteMaterial(look, "", "diffuse=0.25,color=#ffffff");
  EXPECT_EQ(look.material[""].diffuse, 0.25);
}

TEST(Materials, PasteOfAnythingElseChangesNothing) {
  Look look;
  for (const char* text :
       {"", "hello", "[1]", "{}", R"({"exponent": "many"})", R"({"exponent": -1})",
        R"({"exponent": 3, "shine": 4})", "exponent=3,shine=4", R"({"color": [1, 2]})"}) {
    EXPECT_THROW(pasteMaterial(look, "lid", text), InputError) << text;
    EXPECT_EQ(look, Look()) << text;
  }
}

TEST(Materials, ResetLeavesNoTrace) {
  Look look;
  look.material["lid"].exponent = 9;
  look.material["lid"].color = glm::dvec3(1);
  for (const MaterialParameter& p : materialParameters()) resetParameter(look, "lid", p);
  resetColor(look, "lid");
  EXPECT_EQ(look, Look());
}

TEST(Presets, AreWithinTheRangesOfTheParameters) {
  for (const Preset& preset : presets()) {
    const ShadingParameters values = presetParameters(preset);
    for (const MaterialParameter& p : materialParameters()) {
      EXPECT_GE(values.*p.value, p.min) << preset.name << " " << p.name;
      EXPECT_LE(values.*p.value, p.max) << preset.name << " " << p.name;
    }
    if (preset.metal) {
      EXPECT_EQ(values.metalness, 1) << preset.name;
    }
  }
}

TEST(Presets, GoldIsTheTablesGold) {
  const ShadingParameters gold = presetParameters(presets()[0]);
  ASSERT_EQ(presets()[0].name, "gold");
  // 0.75164 in sRGB is 0.5251 in linear light, 0.22648 is 0.0420 (IEC 61966-2-1).
  EXPECT_NEAR(gold.color.r, 0.5251, 1e-4);
  EXPECT_NEAR(gold.color.b, 0.0420, 1e-4);
  EXPECT_NEAR(gold.exponent, 51.2 / 4, 1e-9);
  EXPECT_GT(gold.color.r, gold.color.g);
  EXPECT_GT(gold.color.g, gold.color.b);
}

TEST(Presets, TheFitGivesAGreySpecularColourBack) {
  for (const Preset& preset : presets()) {
    if (preset.name != "jade") continue;
    const ShadingParameters jade = presetParameters(preset);
    // A grey highlight contains nothing of the colour; 0.316228 in sRGB is 0.0815 in linear light.
    EXPECT_NEAR(jade.metalness, 0, 1e-4);
    EXPECT_NEAR(jade.specular, 0.0815, 1e-4);
  }
}

}  // namespace viewer_material_test
}  // namespace glint::viewer
