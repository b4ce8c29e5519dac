#include "glint/study/statistics.h"

#include <gtest/gtest.h>

#include <cmath>

namespace glint {
namespace statistics_test {

TEST(Statistics, QuantilesOfAFewValues) {
  const std::vector<double> values{7, 1, 3, 10};
  EXPECT_EQ(quantile(values, 0), 1);
  EXPECT_EQ(quantile(values, 0.5), 5);
  EXPECT_EQ(quantile(values, 0.25), 2.5);
  EXPECT_EQ(quantile(values, 1), 10);
  EXPECT_EQ(quantile({4.0}, 0.3), 4);
  EXPECT_TRUE(std::isnan(quantile({}, 0.5)));
}

TEST(Statistics, Spread) {
  const Spread spread = spreadOf({5, 1, 4, 2, 3});
  EXPECT_EQ(spread.minimum, 1);
  EXPECT_EQ(spread.lowerQuartile, 2);
  EXPECT_EQ(spread.median, 3);
  EXPECT_EQ(spread.upperQuartile, 4);
  EXPECT_EQ(spread.maximum, 5);
  EXPECT_EQ(spread.count, 5u);
}

// A ratio of three times whose rounds are resampled together: the second half of the rounds is
// twice as slow, and the ratio is unchanged.
TEST(Statistics, FunctionsOfQuartilesBearAChangeOfSpeed) {
  std::vector<double> whole, part, rest;
  for (int i = 0; i < 40; ++i) {
    const double speed = i < 20 ? 1 : 2;
    whole.push_back(10 * speed);
    part.push_back(3 * speed);
    rest.push_back(1 * speed);
  }
  const std::span<const double> times[] = {whole, part, rest};
  const TimeRatio share =
      quartileFunction(times, [](std::span<const double> q) { return (q[1] - q[2]) / q[0]; });
  EXPECT_DOUBLE_EQ(share.value, 0.2);
  EXPECT_NEAR(share.low, 0.2, 1e-12);
  EXPECT_NEAR(share.high, 0.2, 1e-12);
  EXPECT_EQ(quartileFunction({}, [](std::span<const double>) { return 1.0; }).value, 0);
}

}  // namespace statistics_test
}  // namespace glint
