// The errors between two pictures in a study, and the orders of its series.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "glint/study/picture_error.h"
#include "glint/study/series.h"

namespace glint {
namespace study_error_test {

TEST(StudyError, OfKnownDifferences) {
  Radiances truth(1000, glm::dvec3(0.5)), drawn = truth;
  drawn[3].y += 0.25;
  drawn[7].x -= 0.125;
  const PictureError e = errorOf(truth, drawn);
  EXPECT_DOUBLE_EQ(e.max, 0.25);
  EXPECT_DOUBLE_EQ(e.rmse, std::sqrt((0.25 * 0.25 + 0.125 * 0.125) / 3000));
  EXPECT_DOUBLE_EQ(e.relativeRmse, e.rmse / 0.5);
  EXPECT_DOUBLE_EQ(e.offByMore, 2.0 / 1000);
  // For 1000 values the 99.9th percentile lies between the last two: 0.001 * 999 of the way back
  // from the last.
  EXPECT_NEAR(e.percentile999, 0.125 + 0.001 * 0.125, 1e-12);
  EXPECT_GT(e.levels, 20);
}

TEST(StudyError, OfEqualPicturesIsNone) {
  const Radiances black(10, glm::dvec3(0.0));
  const PictureError e = errorOf(black, black);
  EXPECT_EQ(e.max, 0);
  EXPECT_EQ(e.relativeRmse, 0);
  EXPECT_EQ(e.levels, 0);
  EXPECT_EQ(errorOf({}, {}).max, 0);
}

TEST(StudyError, OfWhatIsNoNumberIsInfinite) {
  const Radiances truth(10, glm::dvec3(0.5));
  Radiances drawn = truth;
  drawn[4].z = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(errorOf(truth, drawn).max, std::numeric_limits<double>::infinity());
  EXPECT_EQ(errorOf(truth, drawn).rmse, std::numeric_limits<double>::infinity());
}

// Exposure changes the codes but not linear differences.
TEST(StudyError, ExposureIsOfCodesOnly) {
  const Radiances truth(10, glm::dvec3(0.001)), drawn(10, glm::dvec3(0.00101));
  EXPECT_EQ(errorOf(truth, drawn).levels, 0);
  EXPECT_GT(errorOf(truth, drawn, 256).levels, 0);
  EXPECT_EQ(errorOf(truth, drawn).max, errorOf(truth, drawn, 256).max);
}

TEST(StudyError, FlipLooksAtTheMaskAlone) {
  Image picture{16, 16, std::vector<float>(4 * 256, 0.5f)};
  for (std::size_t i = 3; i < picture.values.size(); i += 4) picture.values[i] = 1;
  StudyMask mask;
  Radiances truth;
  for (std::uint32_t pixel = 100; pixel < 110; ++pixel) {
    mask.pixels.push_back(pixel);
    truth.emplace_back(0.5);
  }
  EXPECT_LT(flipOf(picture, mask, truth, glm::dvec3(0), 1), 1e-6);
  truth.assign(10, glm::dvec3(0.1, 0.5, 0.1));
  EXPECT_GT(flipOf(picture, mask, truth, glm::dvec3(0), 1), 0.1);
}

TEST(StudySeries, OrdersAreThoseOfTheLastStep) {
  StudySeries series;
  series.lines.push_back({"square", {{0.4, 9, 9}, {0.2, 4, 4}, {0.1, 1, 2}}});
  series.lines.push_back({"one point", {{0.4, 9, 9}}});
  setOrders(series);
  EXPECT_DOUBLE_EQ(series.lines[0].orderMax, 2);
  EXPECT_DOUBLE_EQ(series.lines[0].orderRmse, 1);
  EXPECT_EQ(series.lines[1].orderMax, 0);
}

}  // namespace study_error_test
}  // namespace glint
