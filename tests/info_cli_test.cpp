// What `glint info` and `glint backends` tell.

#include <gmock/gmock.h>

#include "command.h"

namespace glint::test::info_cli_test {

using testing::AllOf;
using testing::HasSubstr;

const std::string sphere = shipped + "sphere.glb";

TEST(Info, SaysWhatIsInAModelAndWhichVariantsItNeeds) {
  const Ran text = runGlint({"info", sphere});
  expectDone(text);
  EXPECT_THAT(text.out, AllOf(HasSubstr("5040 triangles"), HasSubstr("phong"),
                              HasSubstr("directional-lights")));
  const Ran ran = runGlint({"info", sphere, "--json", "-", "--shading", "gouraud"});
  expectDone(ran);
  const Json json = Json::parse(ran.out);
  EXPECT_EQ(json["model"], "sphere");
  EXPECT_EQ(json["triangles"], 5040);
  EXPECT_EQ(json["meshes"], 1);
  EXPECT_EQ(json["instances"], 1);
  EXPECT_NEAR(json["radius"].get<double>(), 1, 1e-6);
  EXPECT_EQ(json["materials"].size(), 1u);
  EXPECT_EQ(json["variants"][0]["program"], "gouraud");
  EXPECT_FALSE(json["variants"][0]["reasons"].empty());
  EXPECT_TRUE(json["warnings"].empty());
}

TEST(Info, SaysWhatBecomesOfExtensionsSkinsAndMorphTargets) {
  const Ran lights = runGlint({"info", shipped + "lights.glb"});
  expectDone(lights);
  EXPECT_THAT(lights.out, HasSubstr("KHR_lights_punctual: read (with an exposure"));
  const Ran bend = runGlint({"info", shipped + "bend.glb"});
  expectDone(bend);
  EXPECT_THAT(bend.out, HasSubstr("0: Rod, 4 joints: Joint 0, Joint 1, Joint 2, Joint 3\n"));
  const Ran morph = runGlint({"info", shipped + "morph.glb", "--json", "-"});
  expectDone(morph);
  const auto json = Json::parse(morph.out);
  EXPECT_EQ(json["morphs"], Json::parse(R"([{"mesh": "Ball", "targets": ["Tall", "Cube"]}])"));
  EXPECT_TRUE(json["skins"].empty());
  EXPECT_TRUE(json["extensions"].empty());
  const auto extensions =
      Json::parse(runGlint({"info", shipped + "lights.glb", "--json", "-"}).out)["extensions"];
  ASSERT_EQ(extensions.size(), 1u);
  EXPECT_EQ(extensions[0]["name"], "KHR_lights_punctual");
  EXPECT_EQ(extensions[0]["use"], "read");
  EXPECT_EQ(extensions[0]["required"], false);
}

TEST(Backends, AreListedInTextAndJson) {
  const Ran text = runGlint({"backends"});
  expectDone(text);
  EXPECT_THAT(text.out, AllOf(HasSubstr("egl"), HasSubstr("egl-software"), HasSubstr("osmesa"),
                              HasSubstr("works")));
  const Ran ran = runGlint({"backends", "--json", "-"});
  expectDone(ran);
  const auto json = Json::parse(ran.out);
  ASSERT_EQ(json.size(), 3u);
  EXPECT_EQ(json[0]["name"], "egl");
  EXPECT_EQ(json[1]["name"], "egl-software");
  EXPECT_EQ(json[2]["name"], "osmesa");
  for (const auto& backend : json) {
    EXPECT_TRUE(backend["works"].is_boolean());
    EXPECT_FALSE(backend["detail"].get<std::string>().empty());
  }
}

}  // namespace glint::test::info_cli_test
