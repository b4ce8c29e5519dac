// Names of pictures from a template.

#include <gmock/gmock.h>

#include "../src/cli/output_names.h"
#include "glint/image/error.h"

using glint::outputNames;
using testing::ElementsAre;
using testing::HasSubstr;

namespace {

std::string failure(const std::string& pattern, const std::vector<std::string>& models) {
  try {
    outputNames(pattern, models);
  } catch (const glint::InputError& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace

TEST(OutputNames, StandForModelAndNumber) {
  EXPECT_THAT(outputNames("a.png", {"x/Duck.glb"}), ElementsAre("a.png"));
  EXPECT_THAT(outputNames("out/{model}.png", {"x/Duck.glb", "Box.v2.gltf"}),
              ElementsAre("out/Duck.png", "out/Box.v2.png"));
  EXPECT_THAT(outputNames("{n}-{model}{model}.pfm", {"a.glb", "b.glb"}),
              ElementsAre("0-aa.pfm", "1-bb.pfm"));
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

TEST(OutputNames, TwoPicturesOfOneNameAreRefused) {
  EXPECT_THAT(failure("a.png", {"x/a.glb", "y/b.glb"}),
              testing::AllOf(HasSubstr("x/a.glb"), HasSubstr("y/b.glb"), HasSubstr("a.png"),
                             HasSubstr("{model} or {n}")));
  EXPECT_THAT(failure("{model}.png", {"x/a.glb", "y/a.gltf"}), HasSubstr("x/a.glb"));
  EXPECT_EQ(failure("{model}-{n}.png", {"x/a.glb", "y/a.gltf"}), "no error");
}

TEST(OutputNames, UnknownOrOpenBracesAreRefused) {
  EXPECT_THAT(failure("{name}.png", {"a.glb"}), HasSubstr("unknown {name}"));
  EXPECT_THAT(failure("{}.png", {"a.glb"}), HasSubstr("unknown {}"));
  EXPECT_THAT(failure("a{model.png", {"a.glb"}), HasSubstr("'{' without '}'"));
}
