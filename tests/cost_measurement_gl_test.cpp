// Costs measured on this driver: a complete table, whatever the figures are.

#include <gtest/gtest.h>

#include <algorithm>

#include "glint/study/cost_measurement.h"

namespace glint {
namespace cost_measurement_gl_test {

TEST(CostMeasurementOnGl, FillsATable) {
  const auto context = openContext(Backend::automatic);
  context->makeCurrent();
  double last = -1;
  const CostMeasurement measured =
      measureCosts({0, 1}, {}, [&](std::string_view, double share) { last = share; });
  ASSERT_TRUE(measured.complete);
  EXPECT_EQ(measured.builds, 1);
  EXPECT_GE(last, 0);
  EXPECT_GT(measured.exactNanoseconds, 0);
  const CostTable& t = measured.file.costs;
  EXPECT_EQ(t.lobe(Highlight::exact, 1), 100);
  // Each value is measured, not taken from the shipped table.
  EXPECT_EQ(measured.lobes.size(), 2 + 5 + 3 * 7 + 1 + 7u);
  EXPECT_EQ(measured.reflectances.size(), 2 * 6u);
  for (const MeasuredCost& c : measured.lobes) EXPECT_GE(c.inTable, 1) << c.form;
  for (const MeasuredCost& c : measured.reflectances) EXPECT_GE(c.inTable, 0) << c.form;
  const auto lyon = std::ranges::find(measured.lobes, "lyon:4", &MeasuredCost::form);
  ASSERT_NE(lyon, measured.lobes.end());
  EXPECT_EQ(t.lobe(Highlight::lyon, 4), lyon->inTable);
  EXPECT_EQ(lyon->shipped, CostTable().lobe(Highlight::lyon, 4));
  EXPECT_EQ(t.fresnelDenser.rational, measured.reflectances.back().inTable);
  // Values that are not measured are interpolated.
  const std::vector<double>& integer = t.lobes.at(Highlight::integer);
  EXPECT_NEAR(integer[1], (integer[0] + integer[2]) / 2, 1e-9);
  EXPECT_FALSE(measured.file.gl.renderer.empty());
}

TEST(CostMeasurementOnGl, StopsWithoutATable) {
  const auto context = openContext(Backend::automatic);
  context->makeCurrent();
  int asked = 0;
  EXPECT_FALSE(measureCosts({}, [&] { return ++asked > 3; }, {}).complete);
}

// Costs that cannot be distinguished become equal.
TEST(CostMeasurement, RoundsToMultiplesOfTheNoiseAwayFromTheExactForm) {
  EXPECT_EQ(roundedCost(101.4, 3), 100);
  EXPECT_EQ(roundedCost(98.6, 3), 100);
  EXPECT_EQ(roundedCost(98.4, 3), 97);
  EXPECT_EQ(roundedCost(31.2, 3), 31);
  EXPECT_EQ(roundedCost(31.2, 0), 31.2);
}

}  // namespace cost_measurement_gl_test
}  // namespace glint
