#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <numbers>

#include "viewer/coarse.h"

namespace glint::viewer {
namespace viewer_coarse_test {

using std::numbers::pi;

const std::atomic<bool> goOn = false;

// A unit sphere of rows x 2 rows x 2 triangles; each vertex has its own normal and texture
// coordinate.
Mesh ball(int rows, int material) {
  Mesh mesh;
  mesh.material = material;
  mesh.texcoords.resize(1);
  const int columns = 2 * rows;
  for (int i = 0; i <= rows; ++i)
    for (int j = 0; j <= columns; ++j) {
      const double v = pi * i / rows, u = 2 * pi * j / columns;
      const glm::vec3 p(std::sin(v) * std::cos(u), std::cos(v), std::sin(v) * std::sin(u));
      mesh.positions.push_back(p);
      mesh.normals.push_back(p);
      mesh.texcoords[0].emplace_back(float(j) / float(columns), float(i) / float(rows));
    }
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) {
      const auto k = std::uint32_t(i * (columns + 1) + j), m = k + std::uint32_t(columns) + 1;
      for (const std::uint32_t index : {k, k + 1, m, k + 1, m + 1, m})
        mesh.indices.push_back(index);
    }
  return mesh;
}

Scene balls() {
  Scene scene;
  scene.materials.resize(2);
  scene.meshes = {ball(100, 0), ball(2, 1)};  // 40,000 and 16 triangles
  Mesh dots = ball(50, 1);
  dots.topology = Topology::points;
  scene.meshes.push_back(dots);
  for (int i = 0; i < 3; ++i) {
    Instance instance;
    instance.mesh = i;
    instance.world[3] = glm::dvec4(3 * i, 0, 0, 1);
    scene.instances.push_back(instance);
  }
  return scene;
}

double areaOf(const Mesh& mesh) {
  double area = 0;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const auto at = [&](std::size_t k) { return glm::dvec3(mesh.positions[mesh.indices[i + k]]); };
    area += glm::length(glm::cross(at(1) - at(0), at(2) - at(0))) / 2;
  }
  return area;
}

TEST(Coarse, IsTheSameSceneOfFewerTriangles) {
  const Scene scene = balls();
  const std::size_t drawn = primitivesDrawn(scene);
  EXPECT_EQ(drawn, std::size_t(40000 + 16 + 30000));
  const auto coarse = coarseScene(scene, drawn / 20, goOn);
  if (!coarse) GTEST_SKIP() << "built without meshoptimizer";
  ASSERT_EQ(coarse->meshes.size(), scene.meshes.size());
  ASSERT_EQ(coarse->instances.size(), scene.instances.size());
  EXPECT_LT(primitivesDrawn(*coarse), drawn / 20 * 5 / 4);
  EXPECT_GT(primitivesDrawn(*coarse), drawn / 20 / 3);
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
    const Mesh &full = scene.meshes[i], &mesh = coarse->meshes[i];
    EXPECT_EQ(mesh.material, full.material);
    EXPECT_EQ(mesh.topology, full.topology);
    ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
    ASSERT_EQ(mesh.texcoords.size(), full.texcoords.size());
    EXPECT_EQ(mesh.texcoords[0].size(), mesh.positions.size());
    ASSERT_FALSE(mesh.indices.empty());
    for (const std::uint32_t index : mesh.indices) ASSERT_LT(index, mesh.positions.size());
    for (std::size_t k = 0; k < mesh.positions.size(); ++k)
      ASSERT_EQ(mesh.positions[k], mesh.normals[k]);  // vertices keep their attributes
  }
  EXPECT_EQ(coarse->meshes[1].indices, scene.meshes[1].indices);  // small meshes are unchanged
  // Still a closed ball: an inscribed polyhedron of 2,000 triangles has 99.7 % of its area;
  // clustering, which does not fit the surface, loses some.
  EXPECT_NEAR(areaOf(coarse->meshes[0]) / (4 * pi), 1, 0.05);
  const Bounds a = boundsOf(scene), b = boundsOf(*coarse);
  EXPECT_NEAR(a.radius, b.radius, 0.05);
}

TEST(Coarse, IsGivenUp) {
  const std::atomic<bool> stop = true;
  EXPECT_FALSE(coarseScene(balls(), 100, stop));
}

Light shining(glm::dvec3 way, glm::dvec3 intensity) {
  Light light;
  light.direction = way;
  light.intensity = intensity;
  return light;
}

TEST(FewerLights, BringAsMuchLightFromAsManyWays) {
  const Scene scene = balls();
  const Bounds bounds = boundsOf(scene);
  Look look;
  look.light.emplace();
  glm::dvec3 before(0.0), way(0.0);
  for (int i = 0; i < 60; ++i) {
    const double turn = 2 * pi * i / 60;
    look.light->push_back(
        shining({std::cos(turn), std::sin(turn), 0.5}, {0.1 + 0.01 * i, 0.2, i % 2 ? 0.5 : 0.0}));
    before += look.light->back().intensity;
  }
  const Look fewer = withFewerLights(scene, bounds, look, 8);
  ASSERT_EQ(fewer.light->size(), 8u);
  glm::dvec3 after(0.0);
  for (const Light& light : *fewer.light) {
    after += light.intensity;
    way += light.direction;
  }
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(before[c], after[c], 1e-12);
  EXPECT_LT(std::hypot(way.x, way.y) / 8, 0.3);  // from all directions, as before
  EXPECT_EQ(fewer.shading, look.shading);
}

// Equal directions, whose cosine rounds to above 1, and intensities for which that matters.
TEST(FewerLights, MayAllShineFromOnePlace) {
  const Scene scene = balls();
  for (int i = 0; i < 100; ++i) {
    Look look;
    look.light.emplace();
    for (int k = 0; k < 20; ++k)
      look.light->push_back(shining({0.1 + i, 0.7, 0.3 * i}, glm::dvec3(1e25)));
    const Look fewer = withFewerLights(scene, boundsOf(scene), look, 8);
    ASSERT_EQ(fewer.light->size(), 8u);
    double after = 0;
    for (const Light& light : *fewer.light) {
      EXPECT_EQ(light.direction, look.light->front().direction);
      EXPECT_GE(light.intensity.r, 1e25);
      after += light.intensity.r;
    }
    EXPECT_NEAR(after, 20e25, 1e12);
  }
}

TEST(FewerLights, CountWhatArrives) {
  const Scene scene = balls();
  const Bounds bounds = boundsOf(scene);
  // Far and strong, near and weak: both bring 1 from the same side. And a weak one between them.
  Light far, near, dim;
  for (Light* light : {&far, &near, &dim}) {
    light->type = Light::Type::point;
    light->fallsOff = true;
  }
  far.position = bounds.center + glm::dvec3(0, 0, 1000);
  far.intensity = glm::dvec3(1e6);
  near.position = bounds.center + glm::dvec3(0, 0, 10);
  near.intensity = glm::dvec3(100);
  dim.position = bounds.center + glm::dvec3(0, 0, -10);
  dim.intensity = glm::dvec3(50);
  Look look;
  look.light = {far, near, dim};
  EXPECT_EQ(withFewerLights(scene, bounds, look, 3), look);
  const Look two = withFewerLights(scene, bounds, look, 2);
  ASSERT_EQ(two.light->size(), 2u);
  double arriving = 0;
  for (const Light& light : *two.light) {
    const double distance = glm::length(light.position - bounds.center);
    arriving += light.intensity.r / (distance * distance);
  }
  EXPECT_NEAR(arriving, 2.5, 1e-9);
  EXPECT_EQ((*two.light)[1], dim);  // on the other side, so it is kept
  const Look one = withFewerLights(scene, bounds, look, 1);
  EXPECT_EQ(one.light->size(), 1u);
}

TEST(FewerLights, OfTheFileBecomeTheLooksOwn) {
  Scene scene = balls();
  for (int i = 0; i < 20; ++i) {
    FileLight light;
    light.direction = glm::normalize(glm::dvec3(std::cos(i), std::sin(i), 0.3));
    scene.lights.push_back(light);
  }
  const Look look;
  const Look fewer = withFewerLights(scene, boundsOf(scene), look, 8);
  ASSERT_TRUE(fewer.light);
  EXPECT_EQ(fewer.light->size(), 8u);
  Look none = look;
  none.noLights = true;
  EXPECT_EQ(withFewerLights(scene, boundsOf(scene), none, 8), none);
}

}  // namespace viewer_coarse_test
}  // namespace glint::viewer
