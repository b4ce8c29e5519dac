// A mesh with many instances is drawn by instanced calls, and looks the same as drawn one by one.

#include <gmock/gmock.h>

#include "glint/render/draw_list.h"
#include "random.h"
#include "stage.h"

namespace glint::test::instancing_gl_test {

// Spheres in a row in depth, so that each one's position and normals matter.
Scene crowd(int count) {
  Random random(11);
  Scene scene = sceneOf(sphere(12, 8), materialOf(0.9, 0.8, 0.6, 30, 0.2, {0.8, 0.6, 0.4}));
  scene.instances.clear();
  for (int i = 0; i < count; ++i)
    scene.instances.push_back(
        {0, translation({6 * random.unit() - 3, 6 * random.unit() - 3, 6 * random.unit() - 3}) *
                rotation(random.unit() * 6) * scaling(glm::dvec3(0.2 + 0.2 * random.unit()))});
  return scene;
}

DrawList listOf(const Scene& scene, const Look& look) {
  return glint::makeDrawList(scene, boundsOf(scene), look);
}

class Instancing : public OnStage {};

TEST(DrawCalls, TakeWhatDiffersInItsPlaceAlone) {
  const auto sizes = [](const Scene& scene, const Look& look = {}) {
    const DrawList list = listOf(scene, look);
    std::vector<std::size_t> counts;
    std::size_t next = 0;
    for (const glint::DrawCall& call : drawCalls(list.items)) {
      EXPECT_EQ(call.first, next);
      next += call.count;
      counts.push_back(call.count);
    }
    EXPECT_EQ(next, list.items.size());
    return counts;
  };
  using testing::ElementsAre;
  EXPECT_THAT(sizes(crowd(3)), ElementsAre(1, 1, 1));  // too few for a program of their own
  EXPECT_THAT(sizes(crowd(30)), ElementsAre(30));
  EXPECT_THAT(sizes(crowd(300)), ElementsAre(128, 128, 44));
  Scene scene = crowd(30);
  scene.instances[10].world = scene.instances[10].world * scaling({-1, 1, 1});  // mirrored
  EXPECT_THAT(sizes(scene), ElementsAre(10, 1, 19));
  scene = crowd(20);
  scene.meshes.push_back(scene.meshes[0]);
  for (std::size_t i = 8; i < 20; ++i) scene.instances[i].mesh = 1;
  EXPECT_THAT(sizes(scene), ElementsAre(8, 12));
  scene = crowd(30);
  scene.materials[0].alphaMode = glint::AlphaMode::blend;
  scene.materials[0].alpha = 0.5;
  EXPECT_EQ(sizes(scene).size(), 30u);  // each in its depth order
}

// With every program, with and without multisampling: the same values, except for last bits where
// another program's arithmetic differs, and so for the occasional sample at an edge.
TEST_P(Instancing, LooksAsPieceByPiece) {
  const Scene scene = crowd(200);
  for (const Shading shading :
       {Shading::flat, Shading::gouraud, Shading::phong, Shading::blinnPhong, Shading::environment})
    for (const auto mode : {glint::AntiAliasing::Mode::none, glint::AntiAliasing::Mode::msaa}) {
      Look look;
      look.shading = shading;
      look.resolution = {160, 120};
      look.antiAliasing = {mode, 4};
      look.light = {directional({1, 2, 3}), directional({-2, 1, 1}, {0.3, 0.2, 0.1})};
      const Image together = draw(scene, look);
      // Alternating meshes prevent instancing.
      Scene apart = scene;
      apart.meshes.assign(8, scene.meshes[0]);
      for (std::size_t i = 0; i < apart.instances.size(); ++i) apart.instances[i].mesh = int(i % 8);
      ASSERT_EQ(drawCalls(listOf(apart, look).items).size(), 200u);
      const Image single = draw(apart, look);
      int off = 0;
      for (std::size_t i = 0; i < single.values.size(); ++i)
        off += std::abs(together.values[i] - single.values[i]) > 1e-5f;
      EXPECT_LE(off, 20) << int(shading) << " " << int(mode);
      EXPECT_GT(coveredPixels(together, look.backgroundColor), 3000u);
    }
}

INSTANTIATE_TEST_SUITE_P(Render, Instancing, softwareBackends(), nameOfBackend);

}  // namespace glint::test::instancing_gl_test
