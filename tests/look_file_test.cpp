// Look files: what they hold, and wrong ones are refused.

#include <gmock/gmock.h>

#include "files.h"
#include "looks.h"
#include "scenes.h"

namespace glint::test::look_file_test {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

// Any other is in roundtrip_test.cpp.
TEST(LookFiles, RoundTripTheDefaultLook) { EXPECT_EQ(lookOf(saveLook(Look{})), Look{}); }

// The example in the documentation.
TEST(LookFiles, ReadTheExample) {
  const Look look = lookOf(R"({"glint-look": 1, "shading": "phong", "highlight": "exact",
      "camera-position": [0, 1, 4], "light": ["directional:1,1,1:1,1,1"],
      "resolution": [1024, 1024], "material": {"": {"exponent": 80},
      "Helmet": {"metalness": 1, "color": [0.8, 0.2, 0.1]}}})");
  EXPECT_EQ(look.cameraPosition, glm::dvec3(0, 1, 4));
  ASSERT_TRUE(look.light && look.light->size() == 1);
  EXPECT_EQ(look.light->front().direction, glm::dvec3(1));
  EXPECT_EQ(look.material.at("").exponent, 80);
  EXPECT_EQ(look.material.at("Helmet").color, glm::dvec3(0.8, 0.2, 0.1));
}

TEST(LookFiles, KeepWhatTheyDoNotName) {
  Look look;
  look.exposure = 2;
  look.light = {directional({1, 0, 0})};
  readLook(look, R"({"glint-look": 1, "blinn-factor": 2})", "a.json");
  EXPECT_EQ(look.exposure, 2);
  EXPECT_EQ(look.blinnFactor, 2);
  EXPECT_EQ(look.light->size(), 1u);
  readLook(look, R"({"glint-look": 1, "light": []})", "a.json");
  EXPECT_TRUE(look.light && look.light->empty());  // no lights at all, not the default one
}

TEST(LookFiles, WrongOnesAreRefusedByFileAndKey) {
  const std::pair<const char*, const char*> files[] = {
      {"", "not a look file"},
      {"[]", "not a look file"},
      {"{", "not a look file"},
      {"{}", "glint-look"},
      {R"({"glint-look": 2})", "glint-look"},
      {R"({"glint-look": "1"})", "glint-look"},
      {R"({"glint-look": 1, "shadin": "flat"})", "unknown key \"shadin\""},
      {R"({"glint-look": 1, "shading": 1})", "shading"},
      {R"({"glint-look": 1, "shading": null})", "shading"},
      {R"({"glint-look": 1, "resolution": [1, "2"]})", "resolution"},
      {R"({"glint-look": 1, "resolution": [1, 2, 3]})", "resolution"},
      {R"({"glint-look": 1, "resolution": [1.5, 2]})", "resolution"},
      {R"({"glint-look": 1, "two-sided": 1})", "two-sided"},
      {R"({"glint-look": 1, "light": "camera"})", "light"},
      {R"({"glint-look": 1, "light": [1]})", "light"},
      {R"({"glint-look": 1, "material": []})", "material"},
      {R"({"glint-look": 1, "material": {"": {"shine": 1}}})", "shine"},
      {R"({"glint-look": 1, "material": {"a": {"color": [1, 2]}}})", "color"},
      {R"({"glint-look": 1, "material": {"a": 1}})", "material"},
      {R"({"glint-look": 1, "exposure": 18446744073709551615})", "exposure"},
      {R"({"glint-look": 1, "exposure": 1e999})", "a.json"},
      {R"({"glint-look": 1, "camera-index": 18446744073709551615})", "camera-index"},
      {R"({"glint-look": 1, "camera-view-up": [0, 0, 0]})", "camera-view-up"},
      {R"({"glint-look": 1, "camera-intrinsics": [9, 9, 5, 5], "camera-view-angle": 30})",
       "camera-view-angle"},
      {R"({"glint-look": 1, "camera-intrinsics": [9, 9, 5, 5], "camera-orthographic": true})",
       "camera-orthographic"},
  };
  for (const auto& [text, part] : files) {
    const std::string message = messageOf([&, t = text] { lookOf(t); });
    EXPECT_THAT(message, AllOf(StartsWith("a.json: "), HasSubstr(part), Not(HasSubstr("\n"))))
        << text;
  }
}

}  // namespace glint::test::look_file_test
