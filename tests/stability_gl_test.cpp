// The suite of hard cases on the software backends: all pass, and the textbook forms fail where
// they must, so that a pass means something.

#include <gmock/gmock.h>

#include <set>

#include "glint/stability/profile.h"
#include "glint/stability/search.h"
#include "glint/stability/suite.h"
#include "glsl_probe.h"
#include "stability_forms.h"

namespace glint::test::stability_gl_test {

class Stability : public GlslTest {};

TEST_P(Stability, EveryCasePasses) {
  stability::Bench bench(formsOf("exact", "exact"), glslSources(), setParameter);
  const auto results = stability::runCases(bench, {});
  EXPECT_TRUE(stability::allPassed(results)) << stability::summaryText(results);
}

// That the others pass is in stability_forms_long_test.cpp.
TEST(StabilityForms, TheTextbooksFailWhereTheyMust) {
  const auto context = openContext(Backend::osmesa);
  context->makeCurrent();
  stability::Bench bench(formsOf("pow", "textbook"), glslSources(), setParameter);
  const auto results = stability::runCases(bench, {.ids = textbookFailures, .groups = {}});
  EXPECT_EQ(results.size(), textbookFailures.size());
  for (const stability::CaseResult& r : results) EXPECT_FALSE(r.passed()) << r.item->id;
}

TEST_P(Stability, NothingIsNotANumber) {
  stability::Bench bench(Look(), glslSources(), setParameter);
  const stability::SearchReport report = stability::searchNotFinite(bench, 200000);
  EXPECT_EQ(report.notFinite, 0u) << stability::searchText(report);
  EXPECT_GE(report.evaluations, 200000u);
  EXPECT_EQ(report.scenes, 20u);
}

// Every quality has a verdict and lists what it affects, on any driver.
TEST_P(Stability, TheDriversProfileIsComplete) {
  stability::Bench bench(Look(), glslSources(), setParameter);
  std::set<std::string> names;
  for (const stability::Quality& q : stability::measureProfile(bench)) {
    names.insert(q.name);
    for (const std::string* text : {&q.measured, &q.result, &q.required, &q.verdict, &q.touches})
      EXPECT_FALSE(text->empty()) << q.name;
  }
  for (const char* name :
       {"pow", "exp2", "log2 near 1", "inversesqrt", "normalize", "division", "subnormal numbers",
        "pow(0, 0)", "NaN", "interpolation", "texture filtering", "sRGB textures", "sRGB store",
        "samples", "derivatives"})
    EXPECT_TRUE(names.contains(name)) << name;
}

GLINT_ON_SOFTWARE_BACKENDS(Stability);

}  // namespace glint::test::stability_gl_test
