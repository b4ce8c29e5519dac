#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "glint/scene/look_text.h"
#include "glint/scene/material_parameters.h"
#include "viewer/material_ball.h"
#include "viewer/material_textures.h"
#include "viewer/materials.h"

namespace glint::viewer {
namespace viewer_textures_test {

Scene scene() {
  Scene s;
  s.materials.resize(1);
  Material& m = s.materials[0];
  m.name = "Helmet";
  m.index = 0;
  m.colorTexture.emplace().image = 2;
  m.parameterTextures.metallicRoughness.emplace().image = 1;
  m.parameterTextures.occlusion.emplace().image = 1;
  m.parameterTextures.transmission.emplace().image = 3;  // in a material without transmission
  m.textured = textured::exponent | textured::metalness | textured::ambient;
  return s;
}

TEST(MaterialTextures, AreToldWithWhatTheyDrive) {
  const Scene s = scene();
  const auto all = materialTextures(s, Look{}, 0);
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[0].name, "base colour");
  EXPECT_EQ(all[0].image, 2);
  EXPECT_EQ(all[0].gives, 0u);
  EXPECT_EQ(all[1].drives, "gives exponent, metalness");
  EXPECT_EQ(all[2].drives, "gives ambient");
  EXPECT_EQ(all[2].replaced, 0u);
  EXPECT_TRUE(materialTextures(s, Look{}, -1).empty());
}

TEST(MaterialTextures, AreSwitchedOffByNumbersAndOnAgain) {
  const Scene s = scene();
  Look look;
  switchTexture(look, s, 0, materialTextures(s, look, 0)[1], false);
  EXPECT_EQ(editedMaterial(s.materials[0], look).textured, unsigned(textured::ambient));
  const auto off = materialTextures(s, look, 0)[1];
  EXPECT_EQ(off.replaced, off.gives);
  EXPECT_EQ(effectiveParameters(s, look, 0).exponent, s.materials[0].shading.exponent);
  switchTexture(look, s, 0, off, true);
  EXPECT_EQ(look, Look{});
}

// A preset's colour is shown unchanged, and textures that the file switches off can be switched on.
TEST(MaterialTextures, OfColourNormalAndEmissionAreSwitchedToo) {
  Scene s = scene();
  Look look;
  switchTexture(look, s, 0, materialTextures(s, look, 0)[0], false);
  EXPECT_FALSE(editedMaterial(s.materials[0], look).colorTexture);
  EXPECT_TRUE(materialTextures(s, look, 0)[0].isOff);
  Look said;
  parseMaterialEdit(said, "Helmet:color-texture=off");
  EXPECT_EQ(look, said);
  switchTexture(look, s, 0, materialTextures(s, look, 0)[0], true);
  EXPECT_EQ(look, Look{});
  s.materials[0].switchedOff = switchedOff::color;
  EXPECT_FALSE(editedMaterial(s.materials[0], look).colorTexture);
  switchTexture(look, s, 0, materialTextures(s, look, 0)[0], true);
  EXPECT_TRUE(editedMaterial(s.materials[0], look).colorTexture);
  switchTexture(look, s, 0, materialTextures(s, look, 0)[0], false);
  EXPECT_EQ(look, Look{});
}

TEST(Thumbnails, KeepShapeAndMeans) {
  ByteImage image;
  image.width = 200;
  image.height = 100;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const std::uint8_t board = (x + y) % 2 ? 200 : 100;
      for (const int v : {int(board), x < 100 ? 0 : 255, 7, 0})
        image.values.push_back(std::uint8_t(v));
    }
  const Thumbnail small = thumbnailOf(image, 64);
  EXPECT_EQ(small.width, 64);
  EXPECT_EQ(small.height, 32);
  ASSERT_EQ(small.rgba.size(), 4u * 64 * 32);
  EXPECT_EQ(small.rgba[1], 0);
  EXPECT_EQ(small.rgba[4 * 63 + 1], 255);
  EXPECT_EQ(small.rgba[2], 7);
  EXPECT_EQ(small.rgba[3], 255);  // opaque
  image.channels = 1;
  image.values.assign(200 * 100, 50);
  EXPECT_EQ(thumbnailOf(image, 64).rgba[2], 50);
  EXPECT_TRUE(thumbnailOf(ByteImage{}, 64).rgba.empty());
}

TEST(MaterialBall, HasItsHighlightWhereTheLightIsMirrored) {
  ShadingParameters s;
  s.color = {0.5, 0.1, 0.1};
  s.diffuse = 0.8;
  s.specular = 1;
  s.exponent = 60;
  for (const FitForm form : {FitForm{false, 4}, FitForm{true, 4}}) {
    const Thumbnail ball = ballOf(s, form, 48);
    const auto at = [&](int x, int y) { return ball.rgba.data() + 4 * (48 * y + x); };
    EXPECT_EQ(at(0, 0)[3], 0);
    EXPECT_EQ(at(24, 24)[3], 255);
    // Half way between the light and the viewer: N = (L + V) / |L + V|.
    const glm::dvec3 H =
        glm::normalize(glm::normalize(glm::dvec3(-0.5, 0.7, 1)) + glm::dvec3(0, 0, 1));
    const int x = int((H.x + 1) * 24), y = int((1 - H.y) * 24);
    EXPECT_GT(at(x, y)[1], 240);                    // white
    EXPECT_LT(at(47 - x, 47 - y)[1], at(x, y)[1]);  // the other side is not
    EXPECT_GT(at(24, 24)[0], 2 * at(24, 24)[1]);    // elsewhere it is red
    EXPECT_LT(at(40, 40)[0], at(24, 24)[0]);
  }
}

}  // namespace viewer_textures_test
}  // namespace glint::viewer
