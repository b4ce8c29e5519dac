// Meshes in which each triangle owns its last vertex.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <set>

#include "glint/render/face_mesh.h"
#include "scenes.h"

namespace glint::test::face_mesh_test {

using Triangle = std::array<std::uint32_t, 3>;

// The lexicographically first of the triangle's three rotations, which have the same winding.
Triangle turned(const Triangle& t) {
  return std::min({t, Triangle{t[1], t[2], t[0]}, Triangle{t[2], t[0], t[1]}});
}

void expectFaces(const Mesh& mesh) {
  const FaceMesh faces = makeFaceMesh(mesh);
  ASSERT_EQ(faces.indices.size(), mesh.indices.size() / 3 * 3);
  ASSERT_EQ(faces.normals.size(), faces.source.size());
  ASSERT_EQ(faces.centers.size(), faces.source.size());
  std::set<std::uint32_t> owned;
  for (std::size_t i = 0; i < faces.indices.size(); i += 3) {
    Triangle is, was;
    for (std::size_t k = 0; k < 3; ++k) {
      ASSERT_LT(faces.indices[i + k], faces.source.size());
      is[k] = faces.source[faces.indices[i + k]];
      was[k] = mesh.indices[i + k];
      ASSERT_LT(is[k], mesh.positions.size());
    }
    // The same corners in the same cyclic order: geometry and winding are unchanged.
    EXPECT_EQ(turned(is), turned(was)) << "triangle " << i / 3;
    const std::uint32_t last = faces.indices[i + 2];
    EXPECT_TRUE(owned.insert(last).second) << "triangle " << i / 3 << " shares its last vertex";

    const glm::dvec3 a(mesh.positions[was[0]]), b(mesh.positions[was[1]]),
        c(mesh.positions[was[2]]);
    const glm::dvec3 cross = glm::cross(b - a, c - a);
    const glm::dvec3 center = (a + b + c) / 3.0;
    for (int k = 0; k < 3; ++k) {
      // Rounded once to float from double.
      EXPECT_NEAR(faces.centers[last][k], center[k],
                  1.2e-7 * (1e-30 + std::abs(center[k])) + 1e-15);
      if (glm::dot(cross, cross) > 0) {
        EXPECT_NEAR(faces.normals[last][k], glm::normalize(cross)[k], 1.2e-7);
      }
    }
    const glm::dvec3 n(faces.normals[last]);
    EXPECT_NEAR(glm::dot(n, n), 1, 5e-7);  // three components, each off by half an ulp
  }
}

Mesh randomMesh(unsigned seed, int vertices, int triangles) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> place(-1, 1);
  std::uniform_int_distribution<std::uint32_t> index(0, std::uint32_t(vertices) - 1);
  Mesh mesh;
  for (int i = 0; i < vertices; ++i) {
    mesh.positions.emplace_back(place(random), place(random), place(random));
    mesh.normals.emplace_back(0, 1, 0);
  }
  for (int i = 0; i < 3 * triangles; ++i) mesh.indices.push_back(index(random));
  return mesh;
}

TEST(FaceMesh, EveryTriangleOwnsItsLastVertexAndKeepsItsShape) {
  expectFaces(glint::test::quad());
  expectFaces(glint::test::sphere(16, 8));
  for (unsigned seed = 1; seed < 20; ++seed) expectFaces(randomMesh(seed, int(seed) + 2, 40));
}

TEST(FaceMesh, NeedsAboutAsManyVerticesAsTriangles) {
  const Mesh mesh = glint::test::sphere(64, 32);
  const std::size_t triangles = mesh.indices.size() / 3;
  // Each triangle owns one vertex; at most the mesh's vertices are unowned.
  EXPECT_LE(makeFaceMesh(mesh).source.size(), triangles + mesh.positions.size() / 8);
}

TEST(FaceMesh, TakesAVertexNormalWhereAFaceHasNoArea) {
  Mesh mesh = glint::test::quad({1, 2, 2});
  mesh.indices = {0, 0, 1};
  const FaceMesh faces = makeFaceMesh(mesh);
  EXPECT_EQ(faces.normals[faces.indices[2]], mesh.normals[0]);
}

TEST(FaceMesh, KeepsTinyAndHugeFacesNormals) {
  for (float scale : {1e-18f, 1e18f}) {
    Mesh mesh = glint::test::sphere(8, 4);
    for (glm::vec3& p : mesh.positions) p *= scale;
    expectFaces(mesh);
  }
}

TEST(FaceMesh, OfNothingIsNothing) { EXPECT_TRUE(makeFaceMesh(Mesh{}).indices.empty()); }

}  // namespace glint::test::face_mesh_test
