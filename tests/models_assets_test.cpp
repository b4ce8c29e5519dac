// Public sample models: animations move the picture, a normal map is visible, and cameras of the
// file can be used.

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "command.h"
#include "glint/image/read_image.h"

namespace glint::test::models_assets_test {

std::string asset(const std::string& name) {
  const char* folder = std::getenv("GLINT_ASSETS");
  EXPECT_NE(folder, nullptr) << "set GLINT_ASSETS to the folder of the sample models";
  return std::string(folder ? folder : "") + "/models/" + name;
}

Image draw(const std::string& model, const std::vector<std::string>& options,
           const std::string& warning = "") {
  Folder folder("models");
  std::vector<std::string> arguments{"render",       model,   "-o", folder / "picture.pfm",
                                     "--resolution", "120,90"};
  arguments.insert(arguments.end(), options.begin(), options.end());
  const Ran ran = glint::test::runGlint(arguments);
  EXPECT_EQ(ran.status, 0) << ran.err;
  EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), warning.empty() ? 0 : 1) << ran.err;
  EXPECT_NE(ran.err.find(warning), std::string::npos) << ran.err;
  return glint::readImage(folder / "picture.pfm");
}

/// The fraction of pixels that differ by more than half a level of 255.
double changed(const Image& a, const Image& b) {
  EXPECT_EQ(a.values.size(), b.values.size());
  std::size_t count = 0;
  for (std::size_t i = 0; i + 3 < std::min(a.values.size(), b.values.size()); i += 4) {
    bool differs = false;
    for (std::size_t k = i; k < i + 3; ++k)
      differs |= std::abs(a.values[k] - b.values[k]) > 0.5f / 255;
    count += differs;
  }
  return 4.0 * double(count) / double(a.values.size());
}

TEST(AssetPictures, AnimationsMoveWhatIsDrawn) {
  for (const char* name :
       {"AnimatedMorphCube.glb", "RiggedSimple.glb", "CesiumMan.glb", "Monster.glb"}) {
    SCOPED_TRACE(name);
    const std::string model = asset(name);
    const Image early = draw(model, {"--animation-time", "0.1"});
    const Image later = draw(model, {"--animation-time", "0.8"});
    EXPECT_GT(changed(early, later), 0.005);
    EXPECT_EQ(early.values, draw(model, {"--animation-time", "0.1"}).values);
  }
}

TEST(AssetPictures, NormalMapOfTheHelmetShows) {
  // The same file with the texture's name in the document overwritten by an unknown one of the same
  // length.
  const std::string model = asset("DamagedHelmet.glb");
  std::string bytes = glint::test::contents(model);
  const std::string key = "\"normalTexture\"";
  const std::size_t place = bytes.find(key);
  ASSERT_NE(place, std::string::npos);
  bytes.replace(place, key.size(), "\"unusedTexture\"");
  Folder folder("helmet");
  const std::string plain = folder / "plain.glb";
  std::ofstream(plain, std::ios::binary) << bytes;
  const std::vector<std::string> options{"--shading", "phong"};
  EXPECT_GT(changed(draw(model, options), draw(plain, options)), 0.05);
  // With one normal per face the map is not used.
  const std::vector<std::string> flat{"--shading", "flat"};
  EXPECT_EQ(draw(model, flat, "the normal texture is not used").values, draw(plain, flat).values);
}

TEST(AssetPictures, CamerasOfTheFileServe) {
  const std::string model = asset("Cameras/Cameras.gltf");
  const Image perspective = draw(model, {"--camera-index", "0"});
  const Image orthographic = draw(model, {"--camera-index", "1"});
  EXPECT_GT(changed(perspective, orthographic), 0.005);
  EXPECT_GT(changed(perspective, draw(model, {})), 0.005);
  EXPECT_EQ(glint::test::runGlint({"render", model, "-o", "-", "--camera-index", "7"}).status, 2);
}

}  // namespace glint::test::models_assets_test
