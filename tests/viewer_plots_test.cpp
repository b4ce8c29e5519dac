#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "viewer/compose.h"
#include "viewer/plots.h"

namespace glint::viewer {
namespace viewer_plots_test {

TEST(LobePlot, PeaksAtTheMirrorDirection) {
  LobeInput input;
  input.exponent = 30;
  for (const bool blinn : {false, true}) {
    input.blinn = blinn;
    const LobePlot plot = lobePlot(input, 40);
    const auto peak = std::max_element(plot.exact.points.begin(), plot.exact.points.end(),
                                       [](const auto& a, const auto& b) { return a.y < b.y; });
    EXPECT_NEAR(peak->x, 40, 1e-6);
    EXPECT_NEAR(peak->y, 1, 1e-12);
    EXPECT_EQ(plot.largestDifference, 0);  // the chosen form is the exact one
  }
}

TEST(LobePlot, ShowsHowFarAnApproximationIsOff) {
  LobeInput input;
  input.exponent = 64;
  input.highlight = Highlight::gaussian;
  // 0.134 / alpha, stated above gaussian() in src/glint/shading/lobe.h.
  const double error = lobePlot(input, 0).largestDifference;
  EXPECT_GT(error, 0.8 * 0.134 / 64);
  EXPECT_LT(error, 1.05 * 0.134 / 64);
}

TEST(LobeSurface, StandsAroundTheMirrorDirection) {
  LobeInput input;
  for (const bool blinn : {false, true})
    for (const double exponent : {0.0, 4.0, 500.0}) {
      input.blinn = blinn;
      input.exponent = exponent;
      const LobeSurface surface = lobeSurface(input, 40);
      const std::size_t rows = surface.points.size() / surface.columns;
      ASSERT_EQ(rows * surface.columns, surface.points.size());
      const double a = 40 * std::acos(-1.0) / 180;
      const glm::dvec3 R(std::sin(a), 0, std::cos(a));
      for (std::size_t i = 0; i < rows; ++i) {
        if (exponent == 0) break;  // a lobe with a jump, also at the horizon: depends on rounding
        for (std::size_t j = 0; j < surface.columns; ++j) {
          const glm::dvec3 p = surface.points[surface.columns * i + j];
          ASSERT_GE(p.z, 0);
          ASSERT_LE(glm::length(p), 1 + 1e-12);
          // The two sides of the plane of incidence are symmetric: a row begins at y and passes x.
          const std::size_t mirrored = (surface.columns - 1) / 2 + surface.columns - 1 - j;
          const glm::dvec3 q =
              surface.points[surface.columns * i + mirrored % (surface.columns - 1)];
          ASSERT_NEAR(p.x, q.x, 1e-9);
          ASSERT_NEAR(p.y, -q.y, 1e-9);
        }
      }
      EXPECT_NEAR(glm::length(surface.points[0] - R), 0, 1e-7);  // the peak, in every column
      // In the outermost row the part above the horizon is at most 1 %, except for exponent 0,
      // whose lobe is 1 everywhere (Blinn-Phong: narrower across the plane than in it).
      const glm::dvec3 last = surface.points[surface.columns * (rows - 2)];
      EXPECT_EQ(surface.points.back(), glm::dvec3(0.0));
      if (exponent == 500) {
        EXPECT_LE(glm::length(last), 0.0101);
      }
      if (exponent == 0) {
        EXPECT_NEAR(glm::length(surface.points[surface.columns]), 1, 1e-12);
      }
    }
}

TEST(FresnelPlot, KnowsTheAnglesOfGlass) {
  const FresnelPlot in = fresnelPlot(Fresnel::exact, 1, 1.5, 5);
  EXPECT_NEAR(in.normalIncidence, 0.04, 1e-12);
  EXPECT_NEAR(in.brewster, 56.309932474020215, 1e-9);  // atan 1.5
  EXPECT_FALSE(in.critical);
  const FresnelPlot out = fresnelPlot(Fresnel::exact, 1.5, 1, 5);
  ASSERT_TRUE(out.critical);
  EXPECT_NEAR(*out.critical, 41.810314895778596, 1e-9);  // asin 1/1.5
  EXPECT_NEAR(out.exact.points.back().y, 1, 1e-12);
}

TEST(FresnelPlot, SchlicksErrorForGlass) {
  // The largest error of Schlick's form for n = 1.5 is about 0.036.
  const double error = fresnelPlot(Fresnel::schlick, 1, 1.5, 5).largestDifference;
  EXPECT_GT(error, 0.02);
  EXPECT_LT(error, 0.05);
}

TEST(WidthPlot, SmallHighlightsAreFourTimesInThePlane) {
  const WidthPlot plot = widthPlot(10000);
  for (const auto& p : plot.inPlane.points) {
    if (p.x < 60) {
      EXPECT_NEAR(p.y, 4, 0.02) << p.x;
    }
  }
  for (const auto& p : plot.across.points) {
    const double c = std::cos(p.x * 3.141592653589793 / 180);
    EXPECT_NEAR(p.y, 4 * c * c, 0.02) << p.x;
  }
}

struct TwoPictures {
  // 4 x 1 pixels.
  std::vector<std::uint8_t> a{10, 20, 30, 255, 10, 20, 30, 255, 10, 20, 30, 255, 10, 20, 30, 255};
  std::vector<std::uint8_t> b{13, 20, 30, 255, 10, 10, 30, 255, 10, 20, 30, 255, 9, 20, 30, 255};
  CodePicture pictureA{4, 1, a.data()}, pictureB{4, 1, b.data()};
};

TEST(Compose, AloneIsTheVeryBytes) {
  const TwoPictures t;
  EXPECT_EQ(compose(t.pictureA, nullptr, {}, false), t.a);
  Document d;
  d.compare = CompareMode::blink;
  EXPECT_EQ(compose(t.pictureA, &t.pictureB, d, false), t.b);
}

TEST(Compose, SplitTakesEachPixelOfOneOfThem) {
  const TwoPictures t;
  Document d;
  d.compare = CompareMode::split;
  d.divider = 0.5;
  const auto out = compose(t.pictureA, &t.pictureB, d, false);
  EXPECT_TRUE(std::equal(out.begin(), out.begin() + 8, t.a.begin()));
  EXPECT_TRUE(std::equal(out.begin() + 8, out.end(), t.b.begin() + 8));
  d.divider = 0;
  EXPECT_EQ(compose(t.pictureA, &t.pictureB, d, false), t.b);
  d.divider = 1;
  EXPECT_EQ(compose(t.pictureA, &t.pictureB, d, false), t.a);
}

TEST(Compose, DifferenceIsMultipliedAndClamped) {
  const TwoPictures t;
  Document d;
  d.compare = CompareMode::difference;
  d.amplification = 30;
  const auto out = compose(t.pictureA, &t.pictureB, d, false);
  EXPECT_EQ(out[0], 90);
  EXPECT_EQ(out[5], 255);
  EXPECT_EQ(out[8], 0);
  EXPECT_EQ(out[12], 30);
  EXPECT_EQ(out[3], 255);
  const CompareNumbers n = compareNumbers(t.pictureA, t.pictureB);
  EXPECT_EQ(n.largest, 10);
  EXPECT_EQ(n.pixels, 3u);
  EXPECT_NEAR(n.mean, 14.0 / 12, 1e-12);
}

TEST(Compose, MarksWhatIsClipped) {
  Image linear{3, 1, {0.5f, 0.5f, 0.5f, 1, 1.5f, 0, 0, 1, NAN, 0, 0, 1}};
  std::vector<std::uint8_t> codes(12, 200);
  EXPECT_EQ(markClipped(codes, linear, 0), 2u);
  EXPECT_EQ(codes[0], 100);
  EXPECT_EQ(codes[4], 255);
  EXPECT_EQ(codes[6], 30);
  EXPECT_EQ(codes[10], 255);
  std::vector<std::uint8_t> brighter(12, 200);
  EXPECT_EQ(markClipped(brighter, linear, 2), 3u);  // 0.5 times 4
}

}  // namespace viewer_plots_test
}  // namespace glint::viewer
