// What points and lines cover in the reference: one pixel of the picture, whatever its
// anti-aliasing, worked out by hand.

#include <gtest/gtest.h>

#include <map>
#include <numeric>
#include <random>

#include "glint/render/thin.h"
#include "glint/scene/look_text.h"
#include "reference_scenes.h"

namespace glint::points_and_lines_test {

using namespace scenes;

constexpr int size = 16;

// Points, or lines between pairs of places; in pixels, y upwards from the lower edge.
Mesh thin(Topology topology, const std::vector<glm::vec2>& places) {
  Mesh mesh;
  mesh.topology = topology;
  for (const glm::vec2& place : places) {
    mesh.indices.push_back(std::uint32_t(mesh.positions.size()));
    mesh.positions.emplace_back(place - float(size / 2), 0.0f);
  }
  return mesh;
}

Image drawn(const Mesh& mesh, const std::string& antiAliasing) {
  Scene scene = sceneOf({{mesh, Material{}}});
  Look look = plainLook(size, size);
  look.antiAliasing = parseAntiAliasing(antiAliasing);
  look.noBackground = true;
  lookAlongZ(scene, look, size / 2);
  return draw(scene, look);
}

// The share of each pixel (column, row from below) that is covered, where it is not 0.
using Shares = std::map<std::pair<int, int>, double>;
Shares sharesOf(const Image& image) {
  Shares shares;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (const double share = pixel(image, x, y).a; share != 0)
        shares[{x, image.height - 1 - y}] = share;
  return shares;
}

void expectShares(const Shares& actual, const Shares& expected, const std::string& what) {
  EXPECT_EQ(actual.size(), expected.size()) << what;
  for (const auto& [place, share] : expected) {
    const auto found = actual.find(place);
    ASSERT_NE(found, actual.end()) << what << " " << place.first << "," << place.second;
    EXPECT_NEAR(found->second, share, 1e-6) << what << " " << place.first << "," << place.second;
  }
}

Shares turned(const Shares& shares) {
  Shares result;
  for (const auto& [place, share] : shares) result[{place.second, place.first}] = share;
  return result;
}

// A square of one pixel about (5.3, 9.8): x from 4.8 to 5.8, y from 9.3 to 10.3.
TEST(ReferencePointCoverage, IsASquareOfOnePixel) {
  const std::map<std::string, Shares> expected = {
      {"none", {{{5, 9}, 1.0}}},
      // Samples at (.375, .125), (.875, .375), (.125, .625), (.625, .875) of each pixel.
      {"msaa:4", {{{5, 9}, 0.5}, {{4, 9}, 0.25}, {{5, 10}, 0.25}}},
      {"ssaa:2", {{{5, 9}, 0.5}, {{5, 10}, 0.5}}},
      {"ssaa:3", {{{5, 9}, 4.0 / 9}, {{4, 9}, 2.0 / 9}, {{5, 10}, 2.0 / 9}, {{4, 10}, 1.0 / 9}}},
      {"ssaa:4",
       {{{5, 9}, 9.0 / 16}, {{4, 9}, 3.0 / 16}, {{5, 10}, 3.0 / 16}, {{4, 10}, 1.0 / 16}}}};
  for (const auto& [antiAliasing, shares] : expected)
    expectShares(sharesOf(drawn(thin(Topology::points, {{5.3f, 9.8f}}), antiAliasing)), shares,
                 antiAliasing);
}

// The left and the lower edge belong to it: half way between pixel centres, the lower ones count.
TEST(ReferencePointCoverage, IsHalfOpen) {
  for (const std::string antiAliasing : {"none", "ssaa:3"}) {
    const Shares shares = sharesOf(drawn(thin(Topology::points, {{5, 9}}), antiAliasing));
    const Shares expected = {
        {{4, 8}, 4.0 / 9}, {{5, 8}, 2.0 / 9}, {{4, 9}, 2.0 / 9}, {{5, 9}, 1.0 / 9}};
    expectShares(shares, antiAliasing == "none" ? Shares{{{4, 8}, 1.0}} : expected, antiAliasing);
  }
  // On a sample's own place, half a pixel away: x from 4.875, where the second sample is.
  expectShares(sharesOf(drawn(thin(Topology::points, {{5.375f, 9.5f}}), "msaa:4")),
               {{{5, 9}, 0.75}, {{4, 9}, 0.25}}, "msaa:4");
}

TEST(ReferencePointCoverage, AddsUpToOnePixelAnywhere) {
  std::mt19937 random(11);
  std::uniform_real_distribution<float> place(1, size - 1);
  for (const std::string antiAliasing :
       {"none", "msaa:2", "msaa:4", "msaa:8", "msaa:16", "ssaa:2", "ssaa:3", "ssaa:4", "ssaa:7"})
    for (int i = 0; i < 50; ++i) {
      const glm::vec2 at(place(random), place(random));
      double sum = 0;
      for (const auto& [where, share] : sharesOf(drawn(thin(Topology::points, {at}), antiAliasing)))
        sum += share;
      EXPECT_NEAR(sum, 1, 1e-6) << antiAliasing << " " << at.x << "," << at.y;
    }
}

// From x = 2 to 14 at the height 9.8: y from 9.3 to 10.3. The same upright.
TEST(ReferenceLineCoverage, IsOnePixelWide) {
  const std::map<std::string, std::pair<double, double>> expected = {
      // rows 9 and 10
      {"none", {1, 0}},
      {"msaa:4", {0.75, 0.25}},
      {"ssaa:2", {0.5, 0.5}},
      {"ssaa:4", {0.75, 0.25}},
      {"ssaa:3", {2.0 / 3, 1.0 / 3}}};
  for (const auto& [antiAliasing, rows] : expected) {
    Shares level;
    for (int x = 2; x < 14; ++x) {
      level[{x, 9}] = rows.first;
      if (rows.second > 0) level[{x, 10}] = rows.second;
    }
    for (const bool backwards : {false, true}) {
      glm::vec2 from(2, 9.8f), to(14, 9.8f);
      if (backwards) std::swap(from, to);
      expectShares(sharesOf(drawn(thin(Topology::lines, {from, to}), antiAliasing)), level,
                   antiAliasing);
      // Upright, the shares of the columns are the same: the samples lie alike in x and y.
      std::swap(from.x, from.y);
      std::swap(to.x, to.y);
      expectShares(sharesOf(drawn(thin(Topology::lines, {from, to}), antiAliasing)), turned(level),
                   "upright " + antiAliasing);
    }
  }
}

// With ends inside pixels: x from 4.6 to 7.3.
TEST(ReferenceLineCoverage, EndsWhereTheLineEnds) {
  const std::vector<glm::vec2> ends = {{4.6f, 9.5f}, {7.3f, 9.5f}};
  // Of the samples at x = .375, .875, .125 and .625: the two beyond .6 in pixel 4, the one before
  // .3 in pixel 7.
  expectShares(sharesOf(drawn(thin(Topology::lines, ends), "msaa:4")),
               {{{4, 9}, 0.5}, {{5, 9}, 1.0}, {{6, 9}, 1.0}, {{7, 9}, 0.25}}, "msaa:4");
  // In quarters of a pixel from 18.4 to 29.2: centres from 18.5 to 28.5.
  expectShares(sharesOf(drawn(thin(Topology::lines, ends), "ssaa:4")),
               {{{4, 9}, 0.5}, {{5, 9}, 1.0}, {{6, 9}, 1.0}, {{7, 9}, 0.25}}, "ssaa:4");
}

// y = x + 1.1. Without multisampling as many samples in each column as for a level line; a
// rectangle is as wide across.
TEST(ReferenceLineCoverage, OfADiagonal) {
  const std::vector<glm::vec2> ends = {{2, 3.1f}, {12, 13.1f}};
  const std::map<std::string, std::array<double, 3>> expected = {
      {"none", {0, 1, 0}},
      {"ssaa:2", {0, 0.75, 0.25}},
      {"ssaa:4", {1.0 / 16, 12.0 / 16, 3.0 / 16}},
      // |y - x - 1.1| < 0.7071, where y - x is the pixel's less 1/4 or 1/2, or more.
      {"msaa:4", {0.25, 1, 0.5}}};
  for (const auto& [antiAliasing, shares] : expected) {
    const Shares all = sharesOf(drawn(thin(Topology::lines, ends), antiAliasing));
    for (int x = 4; x < 10; ++x)
      for (int above = -1; above < 5; ++above) {
        const double share = above >= 0 && above < 3 ? shares[std::size_t(above)] : 0;
        const auto found = all.find({x, x + above});
        EXPECT_NEAR(found == all.end() ? 0 : found->second, share, 1e-6)
            << antiAliasing << " " << x << "," << x + above;
      }
    // The first and the last column too.
    if (antiAliasing == "msaa:4") continue;
    const double sum = std::accumulate(all.begin(), all.end(), 0.0,
                                       [](double s, const auto& each) { return s + each.second; });
    EXPECT_NEAR(sum, 10, 1e-5) << antiAliasing;
  }
}

// Half way between pixel centres, at an integer height: the lower row, as of a triangle; likewise
// the left column.
TEST(ReferenceLineCoverage, IsHalfOpen) {
  Shares level, upright;
  for (int i = 2; i < 14; ++i) level[{i, 7}] = upright[{7, i}] = 1;
  expectShares(sharesOf(drawn(thin(Topology::lines, {{2, 8}, {14, 8}}), "none")), level, "level");
  expectShares(sharesOf(drawn(thin(Topology::lines, {{8, 2}, {8, 14}}), "none")), upright,
               "upright");
}

// A line comes out of a wall where x = 8.5. Of the samples of the pixel (8, 9), those at .875 and
// .625 are in front and that at .125 is behind.
TEST(ReferenceLineDepth, IsThatOfEachSample) {
  Mesh line = thin(Topology::lines, {{2, 9.8f}, {14, 9.8f}});
  line.positions[0].z = -6.5f;
  line.positions[1].z = 5.5f;
  Material white, black;
  white.shading.color = glm::dvec3(1);
  black.shading.color = glm::dvec3(0);
  white.unlit = black.unlit = true;
  Scene scene = sceneOf({{line, white}, {rectangle({-9, -9}, {9, 9}), black}});
  Look look = plainLook(size, size);
  look.antiAliasing = parseAntiAliasing("msaa:4");
  lookAlongZ(scene, look, size / 2, 16);
  const Image image = draw(scene, look);
  const double expected[][2] = {{0, 0}, {0.5, 0}, {0.75, 0.25}};  // columns 7 to 9; rows 9, 10
  for (int x = 7; x < 10; ++x)
    for (int y = 9; y < 11; ++y)
      EXPECT_NEAR(pixel(image, x, size - 1 - y).r, expected[x - 7][y - 9], 1e-6) << x << "," << y;
}

// Red from 0 to 1 between x = 2.6 and 12.6: the values at the centres, and never beyond the ends.
TEST(ReferenceLineValues, AreThoseOfTheLine) {
  Mesh line = thin(Topology::lines, {{2.6f, 9.5f}, {12.6f, 9.5f}});
  line.colors = {{0, 1, 0, 1}, {1, 1, 0, 1}};
  Material white;
  white.shading.color = glm::dvec3(1);
  Scene scene = sceneOf({{line, white}});
  Look look = plainLook(size, size);
  look.noBackground = true;
  lookAlongZ(scene, look, size / 2);
  for (const std::string antiAliasing : {"none", "msaa:4", "ssaa:4"}) {
    look.antiAliasing = parseAntiAliasing(antiAliasing);
    const Image image = draw(scene, look);
    for (int x = 3; x < 12; ++x)
      EXPECT_NEAR(pixel(image, x, 6).r, (x + 0.5 - 2.6) / 10, 1e-6) << antiAliasing << " " << x;
    if (antiAliasing != "msaa:4") continue;
    EXPECT_NEAR(pixel(image, 2, 6).r, 0, 1e-6);
    EXPECT_EQ(pixel(image, 2, 6).a, 0.5);
    EXPECT_NEAR(pixel(image, 12, 6).r, 0.5 * 0.99, 1e-6);  // samples at .125 and .375
  }
}

TEST(ThinWarning, SaysWhatIsThinnerAndWhatToDo) {
  EXPECT_EQ(thinWarning({255, 255}, 4), "");
  EXPECT_EQ(thinWarning({255, 7.5f}, 16),
            "lines are thinner than one pixel: this driver draws them at most 7 samples wide, and "
            "ssaa:16 needs 16: use --anti-aliasing msaa:4");
  EXPECT_EQ(thinWarning({1, 1}, 2),
            "points and lines are thinner than one pixel: this driver draws them at most 1 sample "
            "wide, and ssaa:2 needs 2: use --anti-aliasing msaa:4");
}

}  // namespace glint::points_and_lines_test
