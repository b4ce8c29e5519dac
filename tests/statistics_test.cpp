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

}  // namespace statistics_test
}  // namespace glint
