#include <gtest/gtest.h>

#include <cmath>
#include <thread>

#include "files.h"
#include "glint/image/error.h"
#include "viewer/session.h"

namespace glint::viewer {
namespace viewer_posing_test {

std::string pathOf(const char* name) { return std::string(GLINT_SOURCE_DIR) + "/models/" + name; }

std::shared_ptr<const Model> model(const char* name, const PoseRequest& pose = {}) {
  return loadModel(pathOf(name), pose);
}

// Compares what is drawn, in order: positions and vertices.
void expectSameScene(const Scene& a, const Scene& b) {
  ASSERT_EQ(a.instances.size(), b.instances.size());
  for (std::size_t i = 0; i < a.instances.size(); ++i) {
    EXPECT_EQ(a.instances[i].world, b.instances[i].world);
    const Mesh& p = a.meshes[std::size_t(a.instances[i].mesh)];
    const Mesh& q = b.meshes[std::size_t(b.instances[i].mesh)];
    EXPECT_EQ(p.positions, q.positions);
    EXPECT_EQ(p.normals, q.normals);
    EXPECT_EQ(p.indices, q.indices);
    EXPECT_EQ(p.material, q.material);
  }
}

TEST(Posing, IsWhatReadingInThatPoseGives) {
  for (const char* name : {"bend.glb", "morph.glb"}) {
    std::shared_ptr<const Model> now = model(name);
    for (const double time : {1.0, 0.25, 2.5, 100.0, 0.0}) {
      const std::shared_ptr<const Model> before = now;
      const Scene copy = before->scene;
      now = posed(now, {time, ""});
      const auto fresh = model(name, {time, ""});
      expectSameScene(now->scene, fresh->scene);
      expectSameScene(before->scene, copy);  // unchanged: others may be drawing it
      EXPECT_EQ(now->bounds.center, fresh->bounds.center);
      EXPECT_EQ(now->bounds.radius, fresh->bounds.radius);
      EXPECT_EQ(now->images, before->images);
      const Ray ray{{0.05, 0.3, 5}, {0, 0, -1}};
      const auto hit = now->picker->pick(now->scene, ray, false);
      const auto expected = fresh->picker->pick(fresh->scene, ray, false);
      ASSERT_EQ(hit.has_value(), expected.has_value());
      if (hit) {
        EXPECT_EQ(hit->distance, expected->distance);
      }
    }
    expectSameScene(posed(now, {})->scene, model(name)->scene);
  }
}

TEST(Posing, TheSamePoseIsTheSameModel) {
  const auto bend = model("bend.glb");
  EXPECT_EQ(posed(bend, {}), bend);
  const auto later = posed(bend, {1.0, ""});
  EXPECT_NE(later, bend);
  EXPECT_EQ(posed(later, {1.0, ""}), later);
  const auto teapot = model("teapot.glb");  // nothing moves
  EXPECT_EQ(posed(teapot, {3.0, ""}), teapot);
}

TEST(Posing, TellsWhichMeshesHaveChanged) {
  const auto bend = model("bend.glb");
  const auto one = posed(bend, {1.0, ""}), two = posed(one, {2.0, ""});
  EXPECT_EQ(changedMeshes(*bend, *one).size(), 1u);
  EXPECT_EQ(changedMeshes(*bend, *two).size(), 1u);
  EXPECT_TRUE(changedMeshes(*one, *one).empty());
}

TEST(Posing, AnUnknownAnimationIsRefusedAndTheNextPoseIsRight) {
  const auto bend = model("bend.glb");
  EXPECT_NE(test::messageOf([&] { posed(bend, {1.0, "Jump"}); }).find("Jump"), std::string::npos);
  expectSameScene(posed(bend, {1.0, ""})->scene, model("bend.glb", {1.0, ""})->scene);
}

TEST(Posing, ByManyThreads) {
  const auto bend = model("bend.glb");
  const auto expected = model("bend.glb", {1.5, ""});
  std::vector<std::jthread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&, t] {
      std::shared_ptr<const Model> mine = bend;
      for (int i = 0; i < 10; ++i) mine = posed(mine, {0.1 * i + t, ""});
      expectSameScene(posed(mine, {1.5, ""})->scene, expected->scene);
    });
}

}  // namespace viewer_posing_test
}  // namespace glint::viewer
