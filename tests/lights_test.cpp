// Lights of a model file: reading, the scale that gives a usable picture, and the look.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "glint/render/draw_list.h"
#include "glint/scene/camera.h"
#include "glint/scene/lights.h"
#include "glint/shading/sum.h"
#include "gltf_sample.h"
#include "scenes.h"

namespace glint::test::lights_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using Json = Sample::Json;

void addLight(Sample& sample, Json light, Json node = Json::object()) {
  Json& lights = sample.json["extensions"]["KHR_lights_punctual"]["lights"];
  lights.push_back(std::move(light));
  node["extensions"]["KHR_lights_punctual"]["light"] = lights.size() - 1;
  sample.show(std::move(node));
  sample.json["extensionsUsed"] = {"KHR_lights_punctual"};
}

TEST(FileLights, AreReadWithTheirNodesPlace) {
  Sample sample;
  sample.triangle();
  const double h = std::sqrt(0.5);
  addLight(sample, {{"type", "directional"}, {"intensity", 3}, {"color", {1, 0.5, 0}}},
           {{"rotation", {-h, 0, 0, h}}, {"scale", {5, 5, 5}}});  // -Z rotated to -Y
  addLight(sample, {{"type", "point"}, {"range", 7}, {"name", "lamp"}},
           {{"translation", {1, 2, 3}}});
  addLight(sample,
           {{"type", "spot"}, {"spot", {{"innerConeAngle", 0.2}, {"outerConeAngle", 0.4}}}});
  const Scene scene = sample.load();
  EXPECT_THAT(scene.warnings, ElementsAre(HasSubstr("the light nodes[3] reaches no surface")));
  ASSERT_EQ(scene.lights.size(), 3u);
  EXPECT_EQ(scene.lights[0].type, FileLight::Type::directional);
  EXPECT_NEAR(scene.lights[0].direction.y, -1, 1e-15);
  EXPECT_EQ(scene.lights[0].intensity, glm::dvec3(3, 1.5, 0));
  EXPECT_EQ(scene.lights[1].type, FileLight::Type::point);
  EXPECT_EQ(scene.lights[1].position, glm::dvec3(1, 2, 3));
  EXPECT_EQ(scene.lights[1].range, 7);
  EXPECT_EQ(scene.lights[1].name, "lamp");
  EXPECT_EQ(scene.lights[2].type, FileLight::Type::spot);
  EXPECT_EQ(scene.lights[2].direction, glm::dvec3(0, 0, -1));
  EXPECT_EQ(scene.lights[2].innerAngle, 0.2);
  EXPECT_EQ(scene.lights[2].outerAngle, 0.4);
}

TEST(FileLights, WhatIsOutOfRangeIsMendedAndWhatIsUnknownLeftOut) {
  const auto one = [](Json light) {
    Sample sample;
    sample.triangle();
    addLight(sample, std::move(light));
    return sample.load();
  };
  EXPECT_THAT(one({{"type", "area"}}).lights, IsEmpty());
  EXPECT_THAT(one({{"type", "area"}}).warnings, ElementsAre(HasSubstr("left out")));
  const Scene dark = one({{"type", "point"}, {"intensity", -4}});
  EXPECT_EQ(dark.lights.at(0).intensity, glm::dvec3(0));
  EXPECT_THAT(dark.warnings, ElementsAre(HasSubstr("intensity")));
  const Scene inside =
      one({{"type", "spot"}, {"spot", {{"innerConeAngle", 1}, {"outerConeAngle", 0.5}}}});
  EXPECT_LT(inside.lights.at(0).innerAngle, inside.lights.at(0).outerAngle);
  const Scene wide = one({{"type", "spot"}, {"spot", {{"outerConeAngle", 3}}}});
  EXPECT_EQ(wide.lights.at(0).outerAngle, std::numbers::pi / 2);
}

TEST(FileLights, BrokenOnesAreRefused) {
  const auto errorOf = [](auto breakIt) {
    Sample sample;
    sample.triangle();
    addLight(sample, {{"type", "point"}});
    breakIt(sample.json);
    return sample.error();
  };
  EXPECT_THAT(
      errorOf([](Json& j) { j["nodes"][1]["extensions"]["KHR_lights_punctual"]["light"] = 1; }),
      HasSubstr("nodes[1].extensions.KHR_lights_punctual.light"));
  EXPECT_THAT(
      errorOf([](Json& j) { j["extensions"]["KHR_lights_punctual"]["lights"][0].erase("type"); }),
      HasSubstr("type is missing"));
  EXPECT_THAT(errorOf([](Json& j) {
                j["extensions"]["KHR_lights_punctual"]["lights"][0]["color"] = {1, 2};
              }),
              HasSubstr("color"));
  EXPECT_NE(errorOf([](Json& j) { j["extensions"]["KHR_lights_punctual"] = 7; }), "");
}

/// A square of side 4 in the plane z = 0 with one light.
Scene litSquare(FileLight light) {
  Scene scene = glint::test::sceneOf(glint::test::quad());
  scene.lights.push_back(light);
  return scene;
}

TEST(LightMeter, MakesASunOfAnyStrengthOne) {
  for (const double lux : {1e-3, 1.0, 100000.0}) {
    FileLight sun;
    sun.intensity = glm::dvec3(0.5, 1, 0.25) * lux;
    EXPECT_NEAR(glint::meterLights(litSquare(sun)).scale * lux, 1, 1e-12);
  }
}

TEST(LightMeter, LeavesFivePercentOfTheLitAreaAboveOne) {
  FileLight lamp;
  lamp.type = FileLight::Type::point;
  lamp.position = {0, 0, 0.5};
  lamp.intensity = glm::dvec3(800);
  const double scale = glint::meterLights(litSquare(lamp)).scale;
  // I N.L = 800 h / (r^2 + h^2)^1.5 is 1 / scale on a circle of radius r; divided by the square's
  // area of 16 it is the circle's share. The grid of points is 0.06 wide.
  const double r2 = std::pow(800 * 0.5 * scale, 2.0 / 3) - 0.25;
  EXPECT_NEAR(std::numbers::pi * r2 / 16, 0.05, 0.005);
}

TEST(LightMeter, IsOneWhereNoLightArrives) {
  FileLight behind;
  behind.direction = {0, 0, 1};  // illuminates the back of the square
  EXPECT_EQ(glint::meterLights(litSquare(behind)).scale, 1);
  EXPECT_EQ(glint::meterLights(Scene{}).scale, 1);
  Scene unlit = litSquare({});
  unlit.materials[0].unlit = true;
  EXPECT_EQ(glint::meterLights(unlit).scale, 1);
}

TEST(FileLights, CountUnlessTheLookSaysOtherwise) {
  FileLight lamp;
  lamp.type = FileLight::Type::spot;
  lamp.position = {0, 0, 2};
  lamp.intensity = glm::dvec3(10);
  lamp.range = 9;
  Scene scene = litSquare(lamp);
  scene.lightScale = 0.25;
  Look look;
  Look used = glint::withFileLights(scene, look);
  ASSERT_EQ(used.light.value().size(), 1u);
  const Light& light = used.light->at(0);
  EXPECT_EQ(light.type, Light::Type::spot);
  EXPECT_EQ(light.intensity, glm::dvec3(2.5));
  EXPECT_TRUE(light.fallsOff);
  EXPECT_EQ(light.range, 9);
  EXPECT_NEAR(light.outerAngle, 45, 1e-12);
  look.lightScale = 2;
  EXPECT_EQ(glint::withFileLights(scene, look).light->at(0).intensity, glm::dvec3(20));
  look.noLights = true;
  EXPECT_EQ(glint::withFileLights(scene, look), look);
  look.noLights = false;
  look.light.emplace();
  EXPECT_EQ(glint::withFileLights(scene, look), look);
}

TEST(FileLights, TheVariantHoldsFallOffOnlyWithThem) {
  FileLight lamp;
  lamp.type = FileLight::Type::point;
  lamp.position = {0, 0, 2};
  const Scene scene = litSquare(lamp);
  Look look;
  const auto variant = [&] {
    return glint::makeDrawList(scene, glint::boundsOf(scene), look).items.at(0).variant;
  };
  EXPECT_TRUE(variant().lightFalloff);
  EXPECT_EQ(variant().pointLights, 1);
  Light constant;
  constant.type = Light::Type::point;
  look.light = std::vector{constant};
  EXPECT_FALSE(variant().lightFalloff);
}

TEST(FileLights, OfTooManyTheOnesThatLightMostAreKept) {
  Sample sample;
  sample.triangle();
  sample.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] =
      sample.accessor<float>("VEC3", {0, 0, 1, 0, 0, 1, 0, 0, 1});
  for (int i = 0; i < 200; ++i) {
    addLight(sample, {{"type", "point"}, {"intensity", 1 + (i * 37) % 200}},
             {{"translation", {0, 0, 3}}});
  }
  const Scene scene = sample.load();
  ASSERT_EQ(scene.lights.size(), glint::maxLights);
  for (const FileLight& light : scene.lights) EXPECT_GT(light.intensity.x, 200 - 128);
  EXPECT_THAT(scene.warnings, ElementsAre(HasSubstr("has 200 lights")));
}

TEST(FileLights, TheScaleIsThatOfTheRestPoseAtEveryTime) {
  Sample sample;
  sample.triangle();
  addLight(sample, {{"type", "point"}}, {{"translation", {0, 0, 1}}});
  sample.add(
      "animations",
      {{"samplers",
        {{{"input", sample.accessor<float>("SCALAR", {0, 1})},
          {"output", sample.accessor<float>("VEC3", {0, 0, 1, 0, 0, 9})}}}},
       {"channels", {{{"sampler", 0}, {"target", {{"node", 1}, {"path", "translation"}}}}}}});
  const Scene rest = sample.load(), late = glint::loadGltf(sample.writeGltf(), {1.0, {}});
  EXPECT_EQ(late.lights.at(0).position.z, 9);
  EXPECT_EQ(late.lightScale, rest.lightScale);
}

}  // namespace glint::test::lights_test
