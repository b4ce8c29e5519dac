// What the renderer skips must be invisible: checked triangle by triangle, in double.

#include "glint/render/triangle_runs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "glint/scene/camera.h"

namespace glint::triangle_runs_test {

Mesh bumpySphere(int rows, double bump) {
  Mesh mesh;
  const int columns = 2 * rows;
  for (int i = 0; i <= rows; ++i)
    for (int j = 0; j <= columns; ++j) {
      const double v = M_PI * i / rows, u = 2 * M_PI * j / columns;
      const double r = 1 + bump * std::sin(12 * u) * std::sin(9 * v);
      mesh.positions.emplace_back(r * std::sin(v) * std::cos(u), r * std::cos(v),
                                  r * std::sin(v) * std::sin(u));
    }
  const auto at = [&](int i, int j) { return std::uint32_t(i * (columns + 1) + j); };
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j)
      for (const std::uint32_t k :
           {at(i, j), at(i, j + 1), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)})
        mesh.indices.push_back(k);
  return mesh;
}

struct Clipped {
  glm::dvec4 corners[3];
  // Whether all corners are beyond one side of the picture.
  bool beside() const {
    for (const int axis : {0, 1})
      for (const double sign : {1.0, -1.0}) {
        bool all = true;
        for (const glm::dvec4& c : corners) all = all && sign * c[axis] > c.w;
        if (all) return true;
      }
    return false;
  }
  // The sign of its area on the screen, with any number of corners behind the eye.
  double orientation() const {
    const auto part = [](const glm::dvec4& c) { return glm::dvec3(c.x, c.y, c.w); };
    return glm::determinant(glm::dmat3(part(corners[0]), part(corners[1]), part(corners[2])));
  }
};

TEST(TriangleRuns, HideOnlyWhatNobodySees) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1, 1);
  std::size_t left = 0, whole = 0;
  for (int round = 0; round < 60; ++round) {
    const Mesh mesh = bumpySphere(48, round % 3 * 0.05);
    const auto runs = glint::makeTriangleRuns(mesh);
    std::size_t indices = 0;
    for (const TriangleRun& run : runs) {
      ASSERT_EQ(run.first, indices);
      indices += run.count;
    }
    ASSERT_EQ(indices, mesh.indices.size());

    glm::dmat4 eyeFromModel(1);
    for (int c = 0; c < 3; ++c)
      for (int r = 0; r < 3; ++r) eyeFromModel[c][r] = any(random);
    const bool mirrored = glm::determinant(glm::dmat3(eyeFromModel)) < 0;
    eyeFromModel[3] = glm::dvec4(any(random), any(random), any(random) * 4 - 1, 1);
    glint::Camera camera;
    camera.orthographic = round % 4 == 0;
    camera.halfHeight = 0.5;
    camera.near = 0.01;
    camera.far = 100;
    const glm::dmat4 projection =
        glint::projection(camera, {0, round % 2 ? 0.5 : 0.0}, {1, 1}, round % 5 == 0);
    const bool culls = round % 7 != 0;
    const RunView view{glm::mat4(projection), glm::mat4(eyeFromModel), {512, 256}, culls};

    std::vector<std::uint32_t> firsts;
    std::vector<std::int32_t> counts;
    glint::appendShown(runs, view, firsts, counts);
    std::vector<bool> shown(mesh.indices.size(), false);
    for (std::size_t i = 0; i < firsts.size(); ++i)
      for (std::int32_t k = 0; k < counts[i]; ++k) shown[firsts[i] + std::size_t(k)] = true;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
      ++whole;
      if (shown[i]) continue;
      ++left;
      Clipped triangle;
      for (std::size_t k = 0; k < 3; ++k)
        triangle.corners[k] =
            projection * eyeFromModel * glm::dvec4(mesh.positions[mesh.indices[i + k]], 1);
      const double area = triangle.orientation() * (mirrored ? -1 : 1);
      ASSERT_TRUE(triangle.beside() || (culls && area <= 1e-12))
          << "round " << round << ", triangle " << i / 3;
    }
  }
  // Half of a sphere is back faces, and half of the pictures show half of it.
  EXPECT_GT(left, whole / 4);
}

// Triangles with positions that are not numbers must not be skipped.
TEST(TriangleRuns, ShowWhatCannotBePlaced) {
  const Mesh mesh = bumpySphere(8, 0);
  const double nan = std::nan("");
  for (const double bad : {nan, 0.0, double(INFINITY)}) {
    const RunView view{glm::mat4(1), glm::mat4(float(bad)), {64, 64}, true};
    for (const TriangleRun& run : glint::makeTriangleRuns(mesh)) EXPECT_TRUE(view.mayShow(run));
  }
}

}  // namespace glint::triangle_runs_test
