#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>

#include "glint/image/error.h"
#include "viewer/materials.h"
#include "viewer/own_presets.h"
#include "viewer/recovery.h"
#include "viewer/settings.h"
#include "viewer/xdg.h"

namespace glint::viewer {
namespace viewer_recovery_test {

namespace fs = std::filesystem;

class InAFolder : public testing::Test {
 protected:
  InAFolder() {
    char name[] = "/tmp/glint-recovery-XXXXXX";
    folder_ = mkdtemp(name);
  }
  ~InAFolder() override { fs::remove_all(folder_); }
  fs::path folder_;
};

using RecoveryTest = InAFolder;
using SettingsTest = InAFolder;

Look edited(double exponent) {
  Look look;
  look.material["paint"].exponent = exponent;
  return look;
}

// A process that keeps edits and ends without cleanup, as in a crash.
void crash(const fs::path& folder, const Look& look, const fs::path& model) {
  const pid_t child = fork();
  if (child == 0) {
    Recovery recovery(folder);
    recovery.keep(look, true, model);
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
}

TEST_F(RecoveryTest, EditsOfAProcessThatCrashedAreFoundAndThoseOfALivingOneAreNot) {
  const fs::path state = folder_ / "state" / "glint";
  crash(state, edited(7), folder_ / "a.glb");
  Recovery living(state);
  living.keep(edited(8), true, folder_ / "a.glb");
  const Recovery another(state);
  const auto left = another.left();
  ASSERT_EQ(left.size(), 1u);
  EXPECT_EQ(left[0].look, edited(7));
  EXPECT_EQ(left[0].model, fs::weakly_canonical(folder_ / "a.glb"));
}

TEST_F(RecoveryTest, OnlyEditsOfTheModelAskedForAreFound) {
  crash(folder_, edited(7), folder_ / "a.glb");
  crash(folder_, edited(8), folder_ / "b.glb");
  const Recovery recovery(folder_);
  EXPECT_EQ(recovery.left().size(), 2u);
  ASSERT_EQ(recovery.left(folder_ / "b.glb").size(), 1u);
  EXPECT_EQ(recovery.left(folder_ / "b.glb")[0].look, edited(8));
  EXPECT_TRUE(recovery.left(folder_ / "c.glb").empty());
}

TEST_F(RecoveryTest, WhatIsSavedOrDiscardedLeavesNothing) {
  {
    Recovery recovery(folder_);
    recovery.keep(edited(7), true, {});
    EXPECT_FALSE(fs::is_empty(folder_));
    recovery.keep(edited(7), false, {});
  }
  EXPECT_TRUE(fs::is_empty(folder_));
  {
    Recovery recovery(folder_);
    recovery.keep(edited(7), true, {});
    recovery.clear();
  }
  EXPECT_TRUE(fs::is_empty(folder_));
  crash(folder_, edited(7), {});
  for (const Recovered& each : Recovery(folder_).left()) Recovery::discard(each);
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(RecoveryTest, WritesNotMoreOftenThanItSays) {
  Recovery recovery(folder_);
  recovery.keep(edited(1), true, {});
  recovery.keep(edited(2), true, {});
  EXPECT_TRUE(recovery.waiting());
  usleep(useconds_t(Recovery::leastSeconds * 1.1e6));
  recovery.keep(edited(2), true, {});
  EXPECT_FALSE(recovery.waiting());
}

TEST_F(RecoveryTest, DamagedFilesAndMissingFoldersAreNoEdits) {
  std::ofstream(folder_ / "1-0.json") << "{\"glint-recovery\": 1, \"model\": ";
  std::ofstream(folder_ / "2-0.json") << "{\"model\": \"\", \"look\": {\"exponent\": []}}";
  EXPECT_TRUE(Recovery(folder_).left().empty());
  EXPECT_TRUE(Recovery(folder_ / "none").left().empty());
  Recovery nowhere({});
  nowhere.keep(edited(1), true, {});
  EXPECT_TRUE(nowhere.left().empty());
}

TEST_F(SettingsTest, ComeBackFromTheirFile) {
  setenv("XDG_CONFIG_HOME", folder_.c_str(), 1);
  EXPECT_EQ(loadSettings(), Settings());
  Settings s;
  s.window = {901, 702};
  s.panel = false;
  s.scale = 1.5;
  s.incidence = 12;
  s.lobe = LobeView::inSpace;
  s.amplification = 3;
  saveSettings(s);
  EXPECT_TRUE(fs::exists(folder_ / "glint" / "viewer.json"));
  EXPECT_EQ(loadSettings(), s);
  unsetenv("XDG_CONFIG_HOME");
}

// Saved, listed by name, pasted again, and overwritten even though they have been read.
TEST_F(SettingsTest, OwnPresetsAreTextFiles) {
  setenv("XDG_CONFIG_HOME", folder_.c_str(), 1);
  EXPECT_TRUE(ownPresets().empty());
  ShadingParameters gold;
  gold.exponent = 77;
  gold.color = {1, 0.5, 0.25};
  keepPreset(ownPresetPath("a/b\n#1"), materialText(gold));
  keepPreset(ownPresetPath(".hidden"), "no JSON");
  const auto all = ownPresets();
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].name, "a-b-#1");
  EXPECT_EQ(all[1].name, "material.hidden");
  Look look;
  pasteMaterial(look, "x", ownPresetText(all[0]));
  EXPECT_EQ(look.material["x"].exponent, 77);
  EXPECT_EQ(look.material["x"].color, gold.color);
  EXPECT_THROW(pasteMaterial(look, "x", ownPresetText(all[1])), InputError);
  keepPreset(all[0].path, materialText({}));
  EXPECT_EQ(ownPresetText(all[0]), materialText({}));
  EXPECT_EQ(ownPresetPath("").filename(), "material.json");
  unsetenv("XDG_CONFIG_HOME");
}

TEST_F(SettingsTest, WrongOnesAreDefaults) {
  EXPECT_EQ(readSettings("no JSON"), Settings());
  EXPECT_EQ(readSettings("[1, 2]"), Settings());
  EXPECT_EQ(readSettings(R"({"window": [1, "x"], "panel": 3, "scale": 1e9, "lobe": "round"})"),
            Settings());
}

TEST_F(SettingsTest, FoldersAreThoseOfXdg) {
  setenv("XDG_STATE_HOME", "/somewhere", 1);
  EXPECT_EQ(stateFolder(), "/somewhere/glint");
  setenv("XDG_STATE_HOME", "relative", 1);  // must be ignored
  const std::string home = getenv("HOME") ? getenv("HOME") : "";
  setenv("HOME", "/home/somebody", 1);
  EXPECT_EQ(stateFolder(), "/home/somebody/.local/state/glint");
  EXPECT_EQ(configFolder(), "/home/somebody/.config/glint");
  unsetenv("HOME");
  EXPECT_EQ(configFolder(), "");
  if (!home.empty()) setenv("HOME", home.c_str(), 1);
  unsetenv("XDG_STATE_HOME");
}

}  // namespace viewer_recovery_test
}  // namespace glint::viewer
