// The series of a study compared with known results, on a small scale.

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "glint/study/frame_parts.h"
#include "glint/study/series.h"
#include "stage.h"

namespace glint {
namespace study_series_gl_test {

class StudySeriesOnGl : public testing::Test {
 protected:
  void SetUp() override {
    context_ = openContext(Backend::automatic);
    context_->makeCurrent();
    look_.antiAliasing = {AntiAliasing::Mode::none, 1};
    look_.noBackground = true;
    look_.resolution = {256, 256};
    scene_ = std::make_unique<StudyScene>(sphereScene(4, sphereMaterial()), look_);
    gpu_ = std::make_unique<GpuScene>(scene_->scene, scene_->images);
    renderer_ = std::make_unique<Renderer>();
  }
  void TearDown() override {
    renderer_.reset();
    gpu_.reset();
  }
  SeriesTools tools() { return {*scene_, *gpu_, *renderer_, look_, true, 0, 1, {}, {}}; }

  static const SeriesLine& line(const StudySeries& series, const std::string& name) {
    for (const SeriesLine& each : series.lines)
      if (each.name == name) return each;
    throw Error("no line " + name);
  }

  Look look_;
  std::unique_ptr<Context> context_;
  std::unique_ptr<StudyScene> scene_;
  std::unique_ptr<GpuScene> gpu_;
  std::unique_ptr<Renderer> renderer_;
};

// Flat shading converges with the first order, interpolated light and interpolated normals with the
// second. The tolerances allow for the small number of pixels: triangles of 4 pixels.
TEST_F(StudySeriesOnGl, FinenessShowsTheOrders) {
  const SeriesTools small = tools();
  const StudySeries series = *finenessSeries(small);
  EXPECT_NEAR(line(series, "flat").orderRmse, 1, 0.1);
  EXPECT_NEAR(line(series, "gouraud").orderRmse, 2, 0.2);
  EXPECT_NEAR(line(series, "phong").orderRmse, 2, 0.1);
  // Gouraud's largest error is near (2/3) m_s alpha h^2 of its highlight.
  const SeriesPoint& finest = line(series, "gouraud").points.back();
  EXPECT_NEAR(finest.max / (2.0 / 3 * 0.5 * 40 * finest.x * finest.x), 1, 0.5);
}

// max over x of |exp(-x) - exp(-x / cos^2 theta)|, to which the error of 4 alpha tends for large
// exponents: 0.106, 0.25 and 0.473 at 30, 45 and 60 degrees; 0.135 / alpha at 0.
TEST_F(StudySeriesOnGl, IncidenceShowsHowFarBlinnIsOff) {
  const SeriesTools small = tools();
  const StudySeries series = *incidenceSeries(small);
  const auto& four = line(series, "blinn-phong 4α").points;
  const double expected[] = {0.135 / 50, 0.106, 0.25, 0.473};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(four[i].max / expected[i], 1, 0.06) << four[i].x;
  for (const SeriesPoint& p : line(series, "phong").points) EXPECT_LT(p.max, 4e-5);
  for (std::size_t i = 1; i < four.size(); ++i)
    EXPECT_LT(line(series, "blinn-phong 4α cos θ").points[i].max, four[i].max);
}

// Each picture may be off the exact one by 1e-5 + 4e-6 sqrt(alpha) (docs/accuracy.md), with
// alpha = 160 for Blinn-Phong.
TEST_F(StudySeriesOnGl, AShaderWithEverythingGivesTheSamePicture) {
  const SeriesTools small = tools();
  const auto all = specialisations(small);
  ASSERT_EQ(all.size(), 2u);
  for (const Specialisation& s : all) {
    EXPECT_LT(s.difference, 2 * (1e-5 + 4e-6 * std::sqrt(160))) << s.program;
    EXPECT_EQ(s.times.wall.size(), 2u) << s.program;
  }
}

// Aliasing far larger than the error of a form, and what the filter leaves of it. The truth has
// 8 x 8 samples, whose own error is far below.
TEST_F(StudySeriesOnGl, AliasingIsLargerThanAFormsErrorAndIsFilteredAway) {
  const SeriesTools small = tools();
  const StudySeries series = *aliasingSeries(small);
  const auto at = [&](const char* name) { return line(series, name).points.back(); };
  EXPECT_EQ(at("one sample").x, 10000);
  EXPECT_GT(at("one sample").max, 5 * at("lyon:8, the form").max);
  EXPECT_LT(at("kaplanyan").rmse, 0.8 * at("one sample").rmse);
  EXPECT_LT(at("ssaa:2").rmse, 0.7 * at("one sample").rmse);
  // Multisampling shades once for each triangle in a pixel, and here most pixels have several.
  EXPECT_LT(at("msaa:4").rmse, at("one sample").rmse);
  // A highlight of many pixels needs no filter, and is unchanged.
  const auto& broad = line(series, "kaplanyan").points.front();
  EXPECT_LT(broad.max, 0.05);
}

TEST_F(StudySeriesOnGl, PartsOfAFrameAreSharesOfIt) {
  const auto parts =
      frameParts(*scene_, *gpu_, look_, Shading::phong, FrameClock::cpu, {2, 12, false, {}, {}});
  std::vector<std::string> names;
  double sum = 0;
  for (const FramePart& part : parts) {
    names.push_back(part.name);
    sum += part.share.value;
    EXPECT_GE(part.share.low, 0) << part.name;
    EXPECT_LE(part.share.low, part.share.value) << part.name;
    EXPECT_GE(part.share.high, part.share.value) << part.name;
  }
  EXPECT_EQ(names, (std::vector<std::string>{"vertices", "the target", "filling", "highlights",
                                             "other light"}));
  // Except for parts that came out below 0 and are reported as 0.
  EXPECT_NEAR(sum, 1, 0.3);
}

// Smaller pictures of the same highlight have larger errors, and more samples smaller ones.
TEST_F(StudySeriesOnGl, AliasingGrowsWithDistance) {
  look_.material[""].exponent = 1000;
  const StudySeries series = *distanceSeries(tools());
  const std::vector<SeriesPoint>& one = line(series, "one sample").points;
  ASSERT_EQ(one.size(), 2u);
  EXPECT_EQ(one[0].x, 128);
  EXPECT_EQ(one[1].x, 32);
  EXPECT_GT(one[1].rmse, 2 * one[0].rmse);
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_LT(line(series, "ssaa:2").points[i].rmse, 0.7 * one[i].rmse);
}

// Bumps smaller than a pixel: the normal map's lengths widen the highlight correctly, while
// neighbouring pixels' normals contain no information about them. A model without a normal map has
// no such line.
TEST_F(StudySeriesOnGl, BumpsAreWhatToksvigIsFor) {
  const StudySeries series = *bumpsSeries(tools());
  const auto at = [&](const char* name) { return line(series, name).points.back(); };
  EXPECT_EQ(at("toksvig").x, 32);
  EXPECT_LT(at("toksvig").rmse, 0.5 * at("one sample").rmse);
  EXPECT_LT(at("toksvig").rmse, 0.5 * at("kaplanyan").rmse);
  EXPECT_GT(at("toksvig").milliseconds, 0);
  EXPECT_THROW(line(*distanceSeries(tools()), "toksvig"), Error);
}

// If a model moves by part of a pixel, the error of the change is at most the sum of both pictures'
// errors, and not much less if the highlight is small.
TEST_F(StudySeriesOnGl, MotionIsTheErrorOfTheChange) {
  look_.cameraOrthographic = true;
  const auto pointAt = [&](const StudySeries& series, double x) {
    for (const SeriesPoint& p : line(series, "one sample").points)
      if (p.x == x) return p;
    throw Error("no such point");
  };
  const double change = pointAt(*motionSeries(tools()), 1000).max;
  look_.material[""].exponent = 1000;
  const double before = pointAt(*distanceSeries(tools()), 128).max;
  // 2 halfHeight over 128 pixels, to the right and up: the camera moves to the left and down.
  const Look still = definiteLook(look_, scene_->scene, scene_->bounds);
  const Camera camera = cameraFor(scene_->scene, scene_->bounds, still);
  const glm::dvec3 way =
      camera.axes * glm::dvec3(-2 * camera.halfHeight / 128 * glm::dvec2(0.5, 0.25), 0.0);
  look_ = still;
  *look_.cameraPosition += way;
  *look_.cameraFocalPoint += way;
  const double after = pointAt(*distanceSeries(tools()), 128).max;
  EXPECT_LE(change, before + after);
  EXPECT_GT(change, 0.3 * before);
}

TEST_F(StudySeriesOnGl, StoppedSeriesKeepWhatIsMeasured) {
  SeriesTools small = tools();
  int asked = 0;
  small.stop = [&] { return ++asked > 2; };
  const StudySeries series = *exponentSeries(small);
  ASSERT_FALSE(series.lines.empty());
  EXPECT_EQ(series.lines[0].points.size(), 2u);
  EXPECT_GT(line(series, "pow").points[0].max, 0);
  EXPECT_EQ(line(series, "pow").points[0].milliseconds, 0);
}

}  // namespace study_series_gl_test
}  // namespace glint
