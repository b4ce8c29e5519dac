// Every program on the driver, and identical bits on every backend.

#include <gmock/gmock.h>

#include <cstring>
#include <map>
#include <vector>

#include "glint/gl/check.h"
#include "glint/gltf/scene_file.h"
#include "glint/image/srgb.h"
#include "glint/render/composition.h"
#include "glint/scene/look_text.h"
#include "stage.h"
#include "variants.h"

namespace glint::test::render_backends_gl_test {

class Programs : public OnStage {};

const AntiAliasing everyAntiAliasing[] = {
    {AntiAliasing::Mode::msaa, 4}, {AntiAliasing::Mode::ssaa, 2}, {AntiAliasing::Mode::none, 1}};

// A scene with some of everything: blended, masked, vertex colours, mirrored, uneven scales,
// points, emission, two-sided.
Scene mixedScene() {
  Scene scene = sceneOf(sphere(24, 12), materialOf(1, 0.7, 0.4, 30, 0.5, {0.8, 0.4, 0.2}));
  scene.instances.push_back({0, translation({1.1, 0.2, 0.3}) * scaling({-0.6, 0.4, 0.5})});
  glint::Material glass = materialOf(0.2, 0.3, 0.6, 90);
  glass.alphaMode = glint::AlphaMode::blend;
  glass.alpha = 0.4;
  glass.doubleSided = true;
  glass.shading.transmission = 0.8;
  scene.materials.push_back(glass);
  glint::Mesh ball = sphere(20, 10);
  ball.material = 1;
  for (const glm::vec3& p : ball.positions) ball.colors.emplace_back(glm::abs(p), 1.0f);
  scene.meshes.push_back(ball);
  scene.instances.push_back({1, translation({-0.7, -0.3, 0.6}) * rotation(1)});
  glint::Mesh points = ball;
  points.topology = glint::Topology::points;
  points.material = 0;
  points.indices.clear();
  for (std::uint32_t i = 0; i < points.positions.size(); ++i) points.indices.push_back(i);
  scene.meshes.push_back(points);
  scene.instances.push_back({2, translation({0, 1.2, 0})});
  return scene;
}

std::vector<Image> picturesOn(Backend backend, const std::vector<Scene>& scenes,
                              const std::vector<Look>& looks) {
  Stage& stage = stageKeeper().enter(backend);
  std::vector<Image> images;
  for (const Scene& scene : scenes)
    for (const Look& look : looks) images.push_back(stage.draw(scene, look));
  stageKeeper().leave();
  return images;
}

void expectSameBits(const std::vector<Scene>& scenes, const std::vector<Look>& looks) {
  const auto a = picturesOn(Backend::osmesa, scenes, looks);
  const auto b = picturesOn(Backend::eglSoftware, scenes, looks);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Look& look = looks[i % looks.size()];
    SCOPED_TRACE(testing::Message()
                 << "scene " << i / looks.size() << " under " << glint::shadingName(look.shading)
                 << ", anti-aliasing " << int(look.antiAliasing.mode));
    EXPECT_EQ(differingPixels(a[i], b[i]), 0u);
    EXPECT_TRUE(isFinite(a[i]));
    // Not empty pictures: the models fill at least a twentieth of them.
    EXPECT_GT(coveredPixels(a[i], look.backgroundColor), a[i].values.size() / 4 / 20);
    const std::size_t pixels = a[i].values.size() / 4;
    std::vector<std::uint8_t> codesA(3 * pixels), codesB(3 * pixels);
    EXPECT_EQ(glint::encodeSrgb8Opaque(a[i].values.data(), pixels, 1, codesA.data()), 0u);
    glint::encodeSrgb8Opaque(b[i].values.data(), pixels, 1, codesB.data());
    EXPECT_EQ(codesA, codesB);
  }
}

std::vector<Look> looksOf(int width, int height) {
  std::vector<Look> looks;
  for (glint::Shading shading : everyShading)
    for (const AntiAliasing& antiAliasing : everyAntiAliasing) {
      Look look;
      look.shading = shading;
      look.antiAliasing = antiAliasing;
      look.resolution = {width, height};
      looks.push_back(look);
    }
  return looks;
}

TEST_P(Programs, CompileForEverySampledVariant) {
  const bool fileNames = glint::fileNamesInLines();
  for (const glint::Variant& v : sampledVariants()) {
    const glint::ComposedProgram text = glint::compose(v, {}, fileNames);
    const glint::ShaderSource sources[] = {{GL_VERTEX_SHADER, text.vertex},
                                           {GL_FRAGMENT_SHADER, text.fragment}};
    EXPECT_NO_THROW({
      const glint::Program program(text.name, sources);
      EXPECT_TRUE(program.bindBlock("DrawBlock", 2));
      EXPECT_TRUE(program.bindBlock("MaterialBlock", 3));
      // Exactly the samplers that the variant needs exist.
      EXPECT_EQ(program.uniform("colorTexture") >= 0, v.colorTexture);
      EXPECT_EQ(program.uniform("emissionTexture") >= 0, v.emissionTexture);
      EXPECT_EQ(program.uniform("metallicRoughnessTexture") >= 0, v.metallicRoughnessTexture);
      EXPECT_EQ(program.uniform("occlusionTexture") >= 0, v.occlusionTexture);
      EXPECT_EQ(program.uniform("specularTexture") >= 0, v.specularTexture);
      EXPECT_EQ(program.uniform("transmissionTexture") >= 0, v.transmissionTexture);
    }) << text.name;
  }
  for (auto environment :
       {glint::Environment::studio, glint::Environment::sky, glint::Environment::white}) {
    const glint::ComposedProgram text = glint::composeBackground(environment, {}, fileNames);
    const glint::ShaderSource sources[] = {{GL_VERTEX_SHADER, text.vertex},
                                           {GL_FRAGMENT_SHADER, text.fragment}};
    EXPECT_NO_THROW(glint::Program("background", sources));
  }
  glint::checkGl("compiling");
}

INSTANTIATE_TEST_SUITE_P(Render, Programs, softwareBackends(), nameOfBackend);

TEST(Backends, GiveTheSameBitsOfTheShippedModels) {
  std::vector<Scene> scenes;
  for (const char* name : {"sphere", "torus", "teapot", "sphere-series/sphere-3"})
    scenes.push_back(glint::loadGltf(GLINT_SOURCE_DIR "/models/" + std::string(name) + ".glb"));
  expectSameBits(scenes, looksOf(96, 72));
}

TEST(Backends, GiveTheSameBitsOfAMixedScene) {
  std::vector<Look> looks = looksOf(80, 120);
  for (Look& look : looks) {
    Light point = lightOf(Light::Type::point);
    Light spot = lightOf(Light::Type::spot);
    spot.direction = {-1, -2, -3};
    look.light = {directional({-1, 1, 1}, {0.4, 0.5, 0.6}), point, spot};
    look.environmentBackground = true;
  }
  expectSameBits({mixedScene()}, looks);
}

// A picture of several bands and tiles, and the same picture drawn again.
TEST(Backends, GiveTheSameBitsInTilesAndAgain) {
  Look look;
  look.resolution = {8200, 24};
  look.cameraViewAngle = 4;
  look.antiAliasing = {AntiAliasing::Mode::none, 1};
  Look bands = look;
  bands.resolution = {64, 2100};
  bands.antiAliasing = {AntiAliasing::Mode::ssaa, 8};
  const std::vector<Scene> scenes{sceneOf(sphere(32, 16), materialOf(1, 1, 0.5, 20))};
  const auto a = picturesOn(Backend::osmesa, scenes, {look, bands, look, bands});
  const auto b = picturesOn(Backend::eglSoftware, scenes, {look, bands});
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(differingPixels(a[i], b[i]), 0u);
    EXPECT_EQ(differingPixels(a[i], a[i + 2]), 0u);  // I9
    EXPECT_GT(coveredPixels(a[i], look.backgroundColor), 300u);
  }
}

}  // namespace glint::test::render_backends_gl_test
