// The suite of hard cases on the software backends: all pass, and the textbook forms fail where
// they must, so that a pass means something.

#include <gmock/gmock.h>

#include <set>

#include "glint/options/parameters.h"
#include "glint/stability/profile.h"
#include "glint/stability/search.h"
#include "glint/stability/suite.h"
#include "glsl_probe.h"

namespace glint::stability_gl_test {

class Stability : public GlslTest {};

std::vector<stability::CaseResult> run(const char* highlight, const char* fresnel) {
  Look forms;
  setParameter(forms, "highlight", highlight);
  setParameter(forms, "fresnel", fresnel);
  stability::Bench bench(forms, glslSources(), setParameter);
  return stability::runCases(bench, {});
}

TEST_P(Stability, EveryCasePasses) {
  const auto results = run("exact", "exact");
  EXPECT_TRUE(stability::allPassed(results)) << stability::summaryText(results);
}

// By section: C1 and C5, the peak, which the dot product of rounded vectors misses; D3 and D4, the
// power at large exponents; K3 and K4, nearly equal indices; P10 searches what D3 and D4 sample.
TEST(StabilityForms, TheTextbooksFailWhereTheyMust) {
  const auto context = openContext(Backend::osmesa);
  context->makeCurrent();
  std::set<std::string> failed;
  const auto results = run("pow", "textbook");
  for (const stability::CaseResult& r : results)
    if (!r.passed()) failed.emplace(r.item->id);
  EXPECT_THAT(failed, testing::ElementsAre("C1", "C5", "D3", "D4", "K3", "K4", "P10"))
      << stability::summaryText(results);
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

}  // namespace glint::stability_gl_test
