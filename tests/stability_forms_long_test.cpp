// Every form of lobe and reflectance in every hard case, compared with its own formula in double.

#include <gtest/gtest.h>

#include "glint/gl/context.h"
#include "glint/stability/search.h"
#include "glint/stability/suite.h"
#include "stability_forms.h"

namespace glint::stability_forms_long_test {

struct Forms {
  const char *highlight, *fresnel;
};

class StabilityOfForm : public testing::TestWithParam<Forms> {};

TEST_P(StabilityOfForm, PassesEveryCase) {
  const auto context = openContext(Backend::osmesa);
  context->makeCurrent();
  stability::Bench bench(test::formsOf(GetParam().highlight, GetParam().fresnel), GlslSources(),
                         setParameter);
  const auto results = stability::runCases(bench, {});
  EXPECT_TRUE(stability::allPassed(results)) << stability::summaryText(results);
  const stability::SearchReport report = stability::searchNotFinite(bench, 1000000);
  EXPECT_EQ(report.notFinite, 0u) << stability::searchText(report);
}

// So that a pass means something.
TEST(TextbookForms, FailWhereTheyMustAndNowhereElse) {
  const auto context = openContext(Backend::osmesa);
  context->makeCurrent();
  stability::Bench bench(test::formsOf("pow", "textbook"), GlslSources(), setParameter);
  const auto results = stability::runCases(bench, {});
  std::vector<std::string> failed;
  for (const stability::CaseResult& r : results)
    if (!r.passed()) failed.emplace_back(r.item->id);
  EXPECT_EQ(failed, test::textbookFailures) << stability::summaryText(results);
}

INSTANTIATE_TEST_SUITE_P(Forms, StabilityOfForm, testing::Values(Forms{"exact", "schlick"}));

}  // namespace glint::stability_forms_long_test
