#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <set>

#include "glint/image/error.h"
#include "glint/options/parameters.h"
#include "glint/scene/lights.h"
#include "glint/scene/look_text.h"
#include "viewer/edits.h"
#include "viewer/light_edit.h"
#include "viewer/materials.h"
#include "viewer/presets.h"

namespace glint::viewer {
namespace viewer_edits_test {

using testing::HasSubstr;

TEST(Actions, EachHasAKeyOfItsOwn) {
  ASSERT_EQ(actions().size(), std::size_t(Action::count));
  std::map<std::string, int> keys;
  for (int i = 0; i < int(Action::count); ++i) {
    const ActionInfo& info = actions()[std::size_t(i)];
    EXPECT_EQ(int(info.command), i) << info.help;
    EXPECT_GT(info.key, 0) << info.help;
    EXPECT_FALSE(info.help.empty());
    ++keys[keyText(info)];
  }
  for (const auto& [key, uses] : keys) EXPECT_EQ(uses, 1) << key;
  // Synonyms of other keys, and the key that closes.
  for (const char* taken : {"H", "F1", "Ctrl+Y"}) EXPECT_FALSE(keys.contains(taken)) << taken;
  EXPECT_FALSE(std::ranges::any_of(actions(), [](const ActionInfo& i) { return i.key == 256; }));
}

// As in F3D's documentation of its interactions, version 2 and later.
TEST(Actions, AreF3dsWhereTheMeaningIsTheSame) {
  const std::map<Action, std::string> same = {
      {Action::antiAliasing, "A"},    {Action::wireframe, "E"},     {Action::brighter, "L"},
      {Action::darker, "Shift+L"},    {Action::nextAnimation, "W"}, {Action::play, "Space"},
      {Action::resetCamera, "Enter"}, {Action::reload, "Up"},       {Action::screenshot, "F12"},
      {Action::front, "1"},           {Action::right, "3"},         {Action::top, "7"},
      {Action::isometric, "9"},       {Action::orthographic, "5"}};
  for (const auto& [action, key] : same) EXPECT_EQ(keyText(infoOf(action)), key);
}

Session session(const char* model = "preview.glb") {
  Session s;
  s.take(loadModel(std::string(GLINT_SOURCE_DIR) + "/models/" + model));
  return s;
}

// Every action that edits the look changes it, or reports why it does not.
TEST(Edits, EachDoesSomethingOrSaysWhyNot) {
  int edits = 0;
  for (const char* model : {"preview.glb", "bend.glb", "lights.glb"})
    for (int i = 0; i < int(Action::count); ++i) {
      Session s = session(model);
      const Document before = s.document;
      const int material = s.material;
      if (!edit(s, Action(i))) continue;
      ++edits;
      EXPECT_TRUE(s.document != before || s.material != material || !s.status.empty())
          << infoOf(Action(i)).help;
      EXPECT_FALSE(s.status.empty()) << infoOf(Action(i)).help;
    }
  EXPECT_GE(edits, 3 * 25);
}

TEST(Edits, ChoicesComeBackToTheFirst) {
  for (const char* name : {"shading", "fresnel", "viewer", "environment", "highlight"}) {
    Look look;
    const std::string first = saveLook(look);
    std::set<std::string> seen;
    do {
      nextChoice(look, name);
      EXPECT_TRUE(seen.insert(saveLook(look)).second) << name;
      ASSERT_LE(seen.size(), 40u);
    } while (saveLook(look) != first);
    EXPECT_GE(seen.size(), 2u) << name;
  }
}

TEST(Edits, PresetsGoRoundAndBack) {
  Session s = session();
  edit(s, Action::nextMaterial);
  ASSERT_GE(s.material, 0);
  const std::string key = materialKey(s.model->scene, s.material);
  const std::size_t count = presets().size();
  for (std::size_t i = 0; i < count; ++i) {
    edit(s, Action::nextPreset);
    EXPECT_THAT(s.status, HasSubstr(presets()[i].name));
    ASSERT_EQ(presetOf(effectiveParameters(s.model->scene, s.document.a, s.material)), int(i));
  }
  edit(s, Action::nextPreset);
  EXPECT_THAT(s.status, HasSubstr(presets()[0].name));
  edit(s, Action::previousPreset);
  EXPECT_THAT(s.status, HasSubstr(presets()[count - 1].name));
  EXPECT_EQ(s.document.a.material.size(), 1u);
  edit(s, Action::resetMaterial);
  EXPECT_TRUE(s.document.a.material.empty());
}

TEST(Edits, MaterialsAreSelectedInTurn) {
  Session s = session();
  const std::size_t count = drawnMaterials(s.model->scene).size();
  std::set<int> seen;
  for (std::size_t i = 0; i <= count; ++i) {
    seen.insert(s.material);
    edit(s, Action::nextMaterial);
  }
  EXPECT_EQ(seen.size(), count + 1);  // plus the entry for all materials
  edit(s, Action::previousMaterial);
  edit(s, Action::nextMaterial);
  EXPECT_EQ(s.material, -1);
}

// Each file has its own animations, and a look's animation settings do not carry over to another
// file.
TEST(Session, AnotherModelBeginsAtRest) {
  Session s = session("bend.glb");
  s.document.a.animation = "0";
  s.document.a.animationTime = 1;
  s.document.a.material["Rubber"].exponent = 3;
  s.document.a.exposure = 1;
  s.take(loadModel(std::string(GLINT_SOURCE_DIR) + "/models/sphere.glb"));
  Look expected;
  expected.exposure = 1;
  EXPECT_EQ(s.document.a, expected);
  EXPECT_TRUE(s.log.empty());
}

TEST(Session, WhatTheModelDoesNotHaveIsTold) {
  Session s;
  s.document.a.material["Ruber"].exponent = 3;
  s.document.a.cameraIndex = 7;
  s.take(loadModel(std::string(GLINT_SOURCE_DIR) + "/models/bend.glb"));
  ASSERT_EQ(s.log.size(), 1u);
  EXPECT_THAT(s.log[0], HasSubstr("has no material 'Ruber', camera 7"));
  EXPECT_EQ(s.document.a, Look());
}

// Another program saves the look while it is being edited here: its changes apply; ours stay,
// unsaved.
TEST(Session, EditsStayWhenTheLookChangesOnDisk) {
  const std::string path = testing::TempDir() + "glint-look-" + std::to_string(getpid()) + ".json";
  const auto write = [&](const Look& look) { std::ofstream(path) << saveLook(look); };
  Look disk;
  disk.exposure = 1;
  write(disk);
  Session s = session();
  readLookFile(s.document.a, path);
  s.saved = s.lookOnDisk = s.document.a;
  s.lookPath = path;
  s.document.a.ambientLight = glm::dvec3(0.5);
  ASSERT_TRUE(s.unsaved());

  disk.exposure = 2;
  disk.twoSided = true;
  write(disk);
  s.reloadLook();
  EXPECT_EQ(s.document.a.ambientLight, glm::dvec3(0.5));
  EXPECT_EQ(s.document.a.exposure, 2);
  EXPECT_TRUE(s.document.a.twoSided);
  EXPECT_TRUE(s.unsaved());
  EXPECT_THAT(s.status, HasSubstr("your edits stay"));

  // Values changed in both places stay as here; without edits the file's look applies entirely.
  disk.ambientLight = glm::dvec3(0.25);
  write(disk);
  s.reloadLook();
  EXPECT_EQ(s.document.a.ambientLight, glm::dvec3(0.5));
  s.document.a = s.saved;
  disk.exposure = 3;
  write(disk);
  s.reloadLook();
  EXPECT_FALSE(s.unsaved());
  EXPECT_EQ(s.document.a, disk);

  // A file that is incomplete or broken changes nothing.
  std::ofstream(path) << "{";
  EXPECT_THROW(s.reloadLook(), InputError);
  EXPECT_EQ(s.document.a, disk);
  std::filesystem::remove(path);
}

TEST(Edits, TimeStaysWithinTheAnimation) {
  Session s = session("bend.glb");
  for (int i = 0; i < 3; ++i) edit(s, Action::later);
  EXPECT_DOUBLE_EQ(*s.document.a.animationTime, 0.3);
  for (int i = 0; i < 5; ++i) edit(s, Action::earlier);
  EXPECT_EQ(*s.document.a.animationTime, 0);
  for (int i = 0; i < 60; ++i) edit(s, Action::later);
  EXPECT_EQ(*s.document.a.animationTime, animationDuration(s.model->scene, s.document.a));
}

// The picture is unchanged, including intensities and fall-off, and also after saving.
TEST(LightEdit, TheFilesLightsBecomeOwnAsTheyAre) {
  Session s = session("lights.glb");
  Look& look = s.document.a;
  const Scene& scene = s.model->scene;
  ASSERT_TRUE(lightsAreTheFiles(&scene, look));
  const std::vector<Light> files = shownLights(&scene, look);
  EXPECT_TRUE(files[1].fallsOff);
  EXPECT_THAT(setLights(look, &scene, s.model->bounds, files), HasSubstr("your own"));
  EXPECT_FALSE(lightsAreTheFiles(&scene, look));
  EXPECT_EQ(shownLights(&scene, look), files);
  Look again;
  readLook(again, saveLook(look), "saved");
  ASSERT_EQ(again.light->size(), files.size());
  for (std::size_t i = 0; i < files.size(); ++i)
    EXPECT_EQ(lightText((*again.light)[i]), lightText(files[i]));
  EXPECT_TRUE((*again.light)[1].fallsOff);
  EXPECT_EQ((*again.light)[1].range, files[1].range);
}

TEST(LightEdit, OneTooBrightForAnOptionGetsWhatArrivesAtTheCentre) {
  Scene scene = session("lights.glb").model->scene;
  Bounds bounds;
  bounds.center = {1, 2, 3};
  scene.lightScale = 1;
  for (FileLight& light : scene.lights) {
    light.intensity = {4e6, 2e6, 0};
    light.position = bounds.center + glm::dvec3(0, 100, 0);
  }
  Look look;
  const std::string told = setLights(look, &scene, bounds, shownLights(&scene, look));
  EXPECT_THAT(told, HasSubstr("2 no longer fall off"));
  EXPECT_THAT(told, testing::Not(HasSubstr("\n")));
  EXPECT_EQ((*look.light)[1].intensity, glm::dvec3(400, 200, 0));
  EXPECT_FALSE((*look.light)[1].fallsOff);
}

TEST(LightEdit, FallOffOnAndOffKeepsTheLightAtTheCentre) {
  Light light;
  light.type = Light::Type::point;
  light.position = {0, 4, 0};
  light.intensity = {1, 0.5, 0.25};
  const Light before = light;
  setFallOff(light, true, Bounds{});
  EXPECT_EQ(light.intensity, 16.0 * before.intensity);
  setFallOff(light, false, Bounds{});
  EXPECT_EQ(light, before);
}

TEST(Edits, BrighterFileLightsStayTheFiles) {
  Session s = session("lights.glb");
  const auto before = shownLights(&s.model->scene, s.document.a);
  edit(s, Action::brighter);
  const auto after = shownLights(&s.model->scene, s.document.a);
  EXPECT_TRUE(lightsAreTheFiles(&s.model->scene, s.document.a));
  for (std::size_t i = 0; i < before.size(); ++i)
    // The scale has four digits.
    EXPECT_NEAR(after[i].intensity.r / before[i].intensity.r, 1.05, 1e-3);
}

}  // namespace viewer_edits_test
}  // namespace glint::viewer
