// Saving from the window's session: what is written into files against what the window shows.

#include "viewer/session.h"

#include <gmock/gmock.h>

#include <filesystem>

#include "files.h"
#include "glint/image/error.h"
#include "glint/scene/material_parameters.h"
#include "gltf_text.h"
#include "scenes.h"
#include "viewer/widgets.h"

namespace glint::test::viewer_session_test {

using viewer::loadModel;
using viewer::Session;

struct Opened {
  explicit Opened(const std::string& name) : folder(name) {
    path = writeGltf("model", sphere(6, 4), nullptr, folder.path());
    session.take(loadModel(path));
  }
  // The material as the file and a look saved now would be drawn.
  ShadingParameters asRendered() {
    session.saveLook(folder / "look.json", {8, 8});
    Look look;
    readLookFile(look, folder / "look.json");
    return withEdits(loadGltf(path).materials[0], look).shading;
  }
  ShadingParameters shown() const {
    return withEdits(session.model->scene.materials[0], session.document.a).shading;
  }
  Folder folder;
  std::string path;
  Session session;
};

// After the material is written into the model's file, taking an edit back shows the value that the
// model was opened with: the file has another one.
TEST(SavedModel, AndALookOfEditsTakenBackGiveThePicture) {
  Opened opened("saved_and_undone");
  Session& session = opened.session;
  const ShadingParameters before = opened.shown();
  session.document.a.material[""].exponent = 77;
  session.document.a.material[""].color = glm::dvec3(0.5, 0.25, 0.125);
  session.saveModel(opened.path);
  EXPECT_EQ(loadGltf(opened.path).materials[0].shading.exponent, 77);
  EXPECT_EQ(opened.asRendered().exponent, 77);
  EXPECT_FALSE(session.unsaved());
  session.document.a.material.clear();
  EXPECT_TRUE(session.unsaved());
  EXPECT_EQ(opened.shown().exponent, before.exponent);
  EXPECT_EQ(opened.asRendered().exponent, before.exponent);
  EXPECT_EQ(opened.asRendered().color, before.color);
  // The file is read again, as when another program has written it.
  session.take(loadModel(opened.path));
  EXPECT_EQ(opened.shown().exponent, before.exponent);
  EXPECT_EQ(opened.shown().color, before.color);
  // Written once more, the file has what is shown.
  session.saveModel(opened.path);
  EXPECT_EQ(loadGltf(opened.path).materials[0].shading.exponent, before.exponent);
}

// The message says that a deleted model can be saved under a name.
TEST(SavedModel, OfADeletedFileIsWhatWasOpened) {
  Opened opened("saved_and_deleted");
  opened.session.document.a.material[""].exponent = 55;
  std::filesystem::remove(opened.path);
  const std::string kept = opened.folder / "kept.gltf";
  opened.session.saveModel(kept);
  EXPECT_EQ(loadGltf(kept).materials[0].shading.exponent, 55);
  EXPECT_FALSE(std::filesystem::exists(opened.path));
}

// ImGui takes what follows "##" for an identity and shows nothing of it.
TEST(ShownNames, KeepAllTheirLetters) {
  using viewer::widgets::shownName;
  EXPECT_EQ(shownName("Metal#2"), "Metal#2");
  EXPECT_EQ(shownName("Metal##rust"), "Metal# #rust");
  EXPECT_EQ(shownName("###"), "# # #");
}

}  // namespace glint::test::viewer_session_test
