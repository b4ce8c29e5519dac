// The teapot: the published data, and the surface made from them.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>
#include <random>

#include "../models/teapot_patches.h"
#include "models_file.h"

namespace models_teapot_test {

using namespace shipped;
using glint::models::teapotPatches;
using glint::models::teapotPoints;

glm::dvec3 controlPoint(int patch, int row, int column) {
  const double(&p)[3] = teapotPoints[teapotPatches[patch][4 * row + column] - 1];
  return {p[0], p[1], p[2]};
}

TEST(TeapotData, HasThePublishedSize) {
  EXPECT_EQ(std::size(teapotPoints), 306u);
  EXPECT_EQ(std::size(teapotPatches), 32u);
  glm::dvec3 least(9.0), most(-9.0);
  for (const auto& p : teapotPoints) {
    least = glm::min(least, glm::dvec3(p[0], p[1], p[2]));
    most = glm::max(most, glm::dvec3(p[0], p[1], p[2]));
  }
  EXPECT_EQ(least, glm::dvec3(-3.0, -2.0, 0.0));
  EXPECT_EQ(most, glm::dvec3(3.525, 2.0, 3.15));
}

/// The round parts: a profile (radius, height) swept through four quarter circles.
TEST(TeapotData, RoundPartsAreProfilesSweptAroundTheAxis) {
  struct Part {
    int firstPatch;
    glm::dvec2 profile[4];
  };
  const Part parts[] = {{0, {{1.4, 2.4}, {1.3375, 2.53125}, {1.4375, 2.53125}, {1.5, 2.4}}},  // rim
                        {4, {{1.5, 2.4}, {1.75, 1.875}, {2.0, 1.35}, {2.0, 0.9}}},  // body
                        {8, {{2.0, 0.9}, {2.0, 0.45}, {1.5, 0.225}, {1.5, 0.15}}},
                        {20, {{0.0, 3.15}, {0.8, 3.15}, {0.0, 2.85}, {0.2, 2.7}}},  // lid
                        {24, {{0.2, 2.7}, {0.4, 2.55}, {1.3, 2.55}, {1.3, 2.4}}},
                        {28, {{0.0, 0.0}, {1.425, 0.0}, {1.5, 0.075}, {1.5, 0.15}}}};  // bottom
  for (const Part& part : parts) {
    for (int quarter = 0; quarter < 4; ++quarter) {
      for (int row = 0; row < 4; ++row) {
        SCOPED_TRACE(testing::Message() << "patch " << part.firstPatch + quarter << " row " << row);
        const auto at = [&](int column) {
          return controlPoint(part.firstPatch + quarter, row, column);
        };
        const double radius = part.profile[row].x;
        // Newell's quarter circles have their inner points at 0.56 (0.5523 is closest to a circle);
        // the knob's widest row, rounded to two digits, at 0.45 / 0.8.
        const double k = part.firstPatch == 20 && row == 1 ? 0.5625 : 0.56;
        const glm::dvec3 up(0.0, 0.0, part.profile[row].y);
        const glm::dvec3 from = at(0) - up, to = at(3) - up;
        EXPECT_NEAR(glm::length(from), radius, 1e-12);
        EXPECT_NEAR(glm::length(to), radius, 1e-12);
        EXPECT_EQ(glm::dot(from, to), 0.0);
        EXPECT_LT(glm::distance(at(1), up + from + k * to), 1e-12);
        EXPECT_LT(glm::distance(at(2), up + to + k * from), 1e-12);
        EXPECT_EQ(at(3), controlPoint(part.firstPatch + (quarter + 1) % 4, row, 0));
      }
    }
  }
}

TEST(TeapotData, HandleAndSpoutAreMirrored) {
  for (int patch = 12; patch < 20; patch += 2) {
    for (int row = 0; row < 4; ++row) {
      for (int column = 0; column < 4; ++column) {
        const glm::dvec3 p = controlPoint(patch, row, column);
        const glm::dvec3 other = controlPoint(patch + 1, row, 3 - column);
        EXPECT_EQ(other, glm::dvec3(p.x, -p.y, p.z)) << patch << ' ' << row << ' ' << column;
        EXPECT_LE(p.y, 0.0);
      }
    }
  }
  for (const int patch : {12, 13, 16, 17}) {  // the second half continues where the first one ends
    for (int column = 0; column < 4; ++column) {
      EXPECT_EQ(controlPoint(patch, 3, column), controlPoint(patch + 2, 0, column));
    }
  }
}

constexpr double teapotScale = 1.5 / 3.15;

/// From the published axes (+Z up) to those of glTF.
glm::dvec3 toModel(const glm::dvec3& p) { return {p.x, p.z, -p.y}; }

using Net = std::array<std::array<glm::dvec3, 4>, 4>;

/// De Casteljau's algorithm down to the 2 by 2 points that span the tangent plane.
std::array<std::array<glm::dvec3, 2>, 2> deCasteljau(Net net, double u, double v) {
  for (int size = 3; size >= 2; --size) {
    for (int i = 0; i < size; ++i) {
      for (int j = 0; j <= size; ++j) {
        net[i][j] = glm::mix(net[i][j], net[i + 1][j], u);
      }
      for (int j = 0; j < size; ++j) {
        net[i][j] = glm::mix(net[i][j], net[i][j + 1], v);
      }
    }
  }
  return {{{net[0][0], net[0][1]}, {net[1][0], net[1][1]}}};
}

TEST(Teapot, HasTheVerticesOfThePatches) {
  const Model model = load("teapot.glb");
  const int steps = 12;
  for (int patch = 0; patch < 32; ++patch) {
    Net net;
    for (int i = 0; i < 16; ++i) {
      net[i / 4][i % 4] = controlPoint(patch, i / 4, i % 4);
    }
    for (int i = 1; i <= steps; i += 3) {
      for (int j = 0; j <= steps; j += 2) {
        const double u = double(i) / steps, v = double(j) / steps;
        const auto last = deCasteljau(net, u, v);
        const glm::dvec3 alongU = glm::mix(last[1][0] - last[0][0], last[1][1] - last[0][1], v);
        const glm::dvec3 alongV = glm::mix(last[0][1] - last[0][0], last[1][1] - last[1][0], u);
        const glm::dvec3 position =
            teapotScale * toModel(glm::mix(glm::mix(last[0][0], last[0][1], v),
                                           glm::mix(last[1][0], last[1][1], v), u));
        const glm::dvec3 normal = toModel(glm::normalize(glm::cross(alongV, alongU)));
        bool isThere = false;
        for (std::size_t k = 0; k < model.positions.size() && !isThere; ++k) {
          isThere = glm::distance(model.positions[k], position) < 2.0 * rounding &&  // up to 1.7
                    glm::distance(model.normals[k], normal) < rounding + 1e-12;
        }
        ASSERT_TRUE(isThere) << "patch " << patch << " at " << u << ", " << v;
      }
    }
  }
}

TEST(Teapot, StandsOnTheGroundAndIsOneAndAHalfHigh) {
  const Model model = load("teapot.glb");
  glm::dvec3 least(9.0), most(-9.0);
  for (const glm::dvec3& p : model.positions) {
    least = glm::min(least, p);
    most = glm::max(most, p);
  }
  // The extremes of the handle, the body's widest ring, the ground and the knob are vertices.
  EXPECT_NEAR(least.x, -3.0 * teapotScale, rounding * 2.0);
  EXPECT_EQ(least.y, 0.0);
  EXPECT_EQ(most.y, 1.5);
  EXPECT_NEAR(least.z, -2.0 * teapotScale, rounding);
  EXPECT_NEAR(most.z, 2.0 * teapotScale, rounding);
  // The lip's edge is the cubic with x = 3.3, 3.525, 3.45, 3.2. Its slope/3 is 0.225 s^2 -
  // 0.15 s t - 0.25 t^2 with s = 1 - t, zero at t/s = (sqrt(0.0225 + 4 * 0.25 * 0.225) - 0.15)/0.5.
  const double ratio = (std::sqrt(0.0225 + 0.225) - 0.15) / 0.5;
  const double t = ratio / (1.0 + ratio), s = 1.0 - t;
  const double tip =
      3.3 * s * s * s + 3.0 * 3.525 * s * s * t + 3.0 * 3.45 * s * t * t + 3.2 * t * t * t;
  // The nearest vertex is at most 1/24 off in t; |x''| is at most 6 * 0.3.
  EXPECT_LE(most.x, tip * teapotScale + 2.0 * rounding);
  EXPECT_GT(most.x, (tip - 0.5 * 1.8 / (24.0 * 24.0)) * teapotScale - 2.0 * rounding);
}

TEST(Teapot, IsSmoothAndHasFourPieces) {
  const Model model = load("teapot.glb");
  // Two per quadrilateral, one at the eight poles of the patches.
  EXPECT_EQ(model.triangleCount(), 32u * 2 * 12 * 12 - 8 * 12);
  // Pot and lid: a pole, and rings of 48. Handle and spout: rings of 24, both ends open. With a
  // crease between patches, its vertices would be stored twice.
  EXPECT_EQ(model.positions.size(), (1u + 48 * 48) + (1u + 48 * 24) + 2u * (24 * 25));
  EXPECT_EQ(openEdges(model), 2u * 48 + 4u * 24);  // rim, edge of the lid, ends
}

TEST(Teapot, IsSymmetric) {
  const Model model = load("teapot.glb");
  const auto isMirrored = [&](std::size_t i, std::size_t k) {
    const glm::dvec3 mirror(1.0, 1.0, -1.0);
    return glm::distance(model.positions[i], mirror * model.positions[k]) < 1e-6 &&
           glm::distance(model.normals[i], mirror * model.normals[k]) < 1e-6;
  };
  for (std::size_t i = 0; i < model.positions.size(); ++i) {
    std::size_t k = 0;
    while (k < model.positions.size() && !isMirrored(i, k)) {
      ++k;
    }
    ASSERT_LT(k, model.positions.size()) << "vertex " << i << " has no mirror image";
  }
}

/// The distance along the ray to the triangle, from either side (Möller and Trumbore 1997).
std::optional<double> hit(const glm::dvec3& origin, const glm::dvec3& direction,
                          const glm::dvec3& a, const glm::dvec3& ab, const glm::dvec3& ac) {
  const glm::dvec3 p = glm::cross(direction, ac);
  const double determinant = glm::dot(ab, p);
  const glm::dvec3 toOrigin = origin - a;
  const double u = glm::dot(toOrigin, p) / determinant;
  const glm::dvec3 q = glm::cross(toOrigin, ab);
  const double v = glm::dot(direction, q) / determinant;
  if (!(u >= 0.0 && v >= 0.0 && u + v <= 1.0)) {
    return std::nullopt;
  }
  return glm::dot(ac, q) / determinant;
}

TEST(Teapot, ShowsItsOutsideFromTheSidesAndBelow) {
  // Rays that do not go down cannot pass between lid and rim, nor into the spout: what they meet
  // first is a front face, unless a part is inside out or there is a hole.
  const Model model = load("teapot.glb");
  std::mt19937 random(1975);
  const auto between = [&](double low, double high) {
    return low + (high - low) * (random() / 4294967296.0);
  };
  int hits = 0;
  for (int ray = 0; ray < 1000; ++ray) {
    const glm::dvec3 target(between(-1.4, 1.6), between(0.0, 1.5), between(-0.9, 0.9));
    const double turn = between(0.0, 2.0 * std::numbers::pi), rise = between(0.0, 1.5);
    const glm::dvec3 direction(std::cos(rise) * std::cos(turn), std::sin(rise),
                               std::cos(rise) * std::sin(turn));
    const glm::dvec3 origin = target - 9.0 * direction;
    double nearest = 1e9, facing = 0.0;
    for (std::size_t t = 0; t < model.triangleCount(); ++t) {
      const glm::dvec3 a = model.corner(t, 0);
      const auto distance =
          hit(origin, direction, a, model.corner(t, 1) - a, model.corner(t, 2) - a);
      if (distance && *distance < nearest) {
        nearest = *distance;
        facing = glm::dot(model.faceNormal(t), direction);
      }
    }
    if (nearest < 1e9) {
      ++hits;
      EXPECT_LT(facing, 0.0) << "ray " << ray << " sees the inside at height "
                             << (origin + nearest * direction).y;
    }
  }
  EXPECT_GT(hits, 300);
}

}  // namespace models_teapot_test
