// Picture names from a template.

#include <gmock/gmock.h>

#include "../src/cli/output_names.h"
#include "files.h"
#include "glint/image/error.h"

namespace glint::output_names_test {

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::string> outputNames(const std::string& pattern,
                                     const std::vector<std::string>& models) {
  const OutputPattern names(pattern, false);
  std::vector<std::string> all;
  for (std::size_t i = 0; i < models.size(); ++i)
    all.push_back(names.name(models[i], i, models.size()));
  return all;
}

std::string failure(const std::string& pattern, bool frames = false) {
  return glint::test::messageOf([&] { OutputPattern names(pattern, frames); });
}

TEST(OutputNames, StandForModelAndNumber) {
  EXPECT_THAT(outputNames("a.png", {"x/Duck.glb"}), ElementsAre("a.png"));
  EXPECT_THAT(outputNames("out/{model}.png", {"x/Duck.glb", "Box.v2.gltf"}),
              ElementsAre("out/Duck.png", "out/Box.v2.png"));
  EXPECT_THAT(outputNames("{n}-{model}{model}.pfm", {"a.glb", "b.glb"}),
              ElementsAre("0-aa.pfm", "1-bb.pfm"));
  // Downloads are often all called scene.gltf.
  EXPECT_THAT(outputNames("{folder}.png", {"x/duck/scene.gltf", "/a/./b/../ship/scene.gltf"}),
              ElementsAre("duck.png", "ship.png"));
  EXPECT_THAT(outputNames("{model}-{folder}.png", {"-"}), ElementsAre("stdin-stdin.png"));
}

TEST(OutputNames, NumbersBeginAtZeroAndHaveOneWidth) {
  const std::vector<std::string> models(11, "a.glb");
  const auto names = outputNames("{n}.png", models);
  EXPECT_EQ(names.front(), "00.png");
  EXPECT_EQ(names[9], "09.png");
  EXPECT_EQ(names.back(), "10.png");
  // Ten models have the numbers 0 to 9: one digit.
  EXPECT_EQ(outputNames("{n}.png", {models.begin(), models.end() - 1}).back(), "9.png");
  EXPECT_EQ(outputNames("{n}.png", {"a.glb"}).front(), "0.png");
}

TEST(OutputNames, FramesAndListsOfUnknownLength) {
  const OutputPattern names("{model}/{frame}.png", true);
  EXPECT_EQ(names.name("a.glb", 0, 1, 7, 36), "a/07.png");
  EXPECT_EQ(OutputPattern("{n}.png", false).name("a.glb", 7, 0), "000007.png");
  EXPECT_EQ(OutputPattern("{n}.png", false).name("a.glb", 12345678, 0), "12345678.png");
  EXPECT_THAT(failure("{frame}.png"), HasSubstr("--turntable"));
  EXPECT_EQ(failure("{frame}.png", true), "no error");
}

TEST(OutputNames, TwoPicturesOfOneNameAreNoticed) {
  glint::NamesTaken taken;
  EXPECT_EQ(taken.take("out/a.png", 3), nullptr);
  EXPECT_EQ(taken.take("out/b.png", 4), nullptr);
  const std::size_t* other = taken.take("./out//a.png", 5);
  ASSERT_NE(other, nullptr);
  EXPECT_EQ(*other, 3u);
}

TEST(OutputNames, TakeAWordBeforeTheEnding) {
  EXPECT_EQ(glint::withWord("a.b/c.png", "depth"), "a.b/c.depth.png");
  EXPECT_EQ(glint::withWord("a.b/c", "depth"), "a.b/c.depth");
}

TEST(OutputNames, UnknownOrOpenBracesAreRefused) {
  EXPECT_THAT(failure("{name}.png"), HasSubstr("unknown {name}"));
  EXPECT_THAT(failure("{}.png"), HasSubstr("unknown {}"));
  EXPECT_THAT(failure("a{model.png"), HasSubstr("'{' without '}'"));
}

}  // namespace glint::output_names_test
