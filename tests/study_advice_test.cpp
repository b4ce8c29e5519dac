// The advice of a study, from given times and errors.

#include "glint/study/advice.h"

#include <gtest/gtest.h>

#include <random>

#include "glint/study/format.h"

namespace glint {
namespace study_advice_test {

VariantResult variantOf(const char* form, double milliseconds, int levels, double rmse) {
  VariantResult v;
  v.variant.name = std::string("phong ") + form;
  v.variant.highlight = form;
  PictureError e;
  e.levels = levels;
  e.rmse = rmse;
  e.max = 3 * rmse;
  v.errors.push_back({Shading::phong, e, 0});
  std::mt19937 random(unsigned(levels) + 7);
  for (int i = 0; i < 40; ++i) {
    const double t = milliseconds * (1 + 0.01 * double(random()) / double(std::mt19937::max()));
    v.times.wall.push_back(t);
    v.times.cpu.push_back(2 * t);
  }
  return v;
}

StudyResult resultOf() {
  StudyResult r;
  r.noise[0].spread = r.noise[1].spread = 0.02;
  r.variants = {variantOf("exact", 10, 0, 1e-8),     variantOf("pow", 9.95, 0, 1e-7),
                variantOf("pade:8", 8.05, 1, 1e-4),  variantOf("lyon:32", 8, 2, 3e-4),
                variantOf("gaussian", 7.2, 4, 1e-3), variantOf("none", 6, 60, 0.1)};
  return r;
}

StudyHead headOf() {
  StudyHead head;
  head.model = "a model";
  head.look.shading = Shading::phong;
  head.look.resolution = {320, 200};
  return head;
}

// Among those within the codes, the most accurate one whose time cannot be distinguished from the
// fastest.
TEST(StudyAdvice, NamesTheCheapestWithinSoManyCodes) {
  const StudyResult r = resultOf();
  const auto forms = advisedForms(headOf(), r);
  ASSERT_EQ(forms.size(), 3u);
  EXPECT_EQ(r.variants[forms[0].variant].variant.highlight, "pade:8");
  EXPECT_EQ(r.variants[forms[1].variant].variant.highlight, "pade:8");
  EXPECT_EQ(r.variants[forms[2].variant].variant.highlight, "gaussian");
  EXPECT_NEAR(forms[0].time.value, 0.805, 0.01);
  EXPECT_LT(forms[0].time.low, forms[0].time.high);
  const std::string text = adviceText(headOf(), r);
  EXPECT_NE(text.find("a model at 320 x 200 pixels by phong"), std::string::npos) << text;
  EXPECT_NE(text.find("within 1 code of the exact picture use `phong pade:8`, which takes 0.80"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find(", as well as for 2 codes; within 4 codes"), std::string::npos) << text;
}

TEST(StudyAdvice, KeepsTheExactFormWhereNothingIsMeasurablyFaster) {
  StudyResult r = resultOf();
  r.variants.resize(2);
  const auto forms = advisedForms(headOf(), r);
  ASSERT_EQ(forms.size(), 3u);
  for (const AdvisedForm& form : forms) EXPECT_EQ(form.variant, 0u);
  EXPECT_NE(adviceText(headOf(), r).find("nothing else is measurably faster"), std::string::npos);
}

TEST(StudyAdvice, GoesByTheClockThatDecides) {
  StudyResult r = resultOf();
  r.clock = FrameClock::cpu;
  for (double& t : r.variants[4].times.cpu) t *= 2;
  EXPECT_EQ(r.variants[advisedForms(headOf(), r)[2].variant].variant.highlight, "pade:8");
  EXPECT_NE(adviceText(headOf(), r).find("by CPU time"), std::string::npos);
}

TEST(StudyAdvice, SaysNothingOfFormsThatItCannotTell) {
  StudyResult r = resultOf();
  r.noFront = "There is no front.";
  EXPECT_TRUE(advisedForms(headOf(), r).empty());
  EXPECT_NE(adviceText(headOf(), r).find("cannot be determined"), std::string::npos);
  EXPECT_EQ(adviceText(headOf(), StudyResult()), "");
}

TEST(StudyAdvice, TellsWhatAFrameTakesItsTimeFor) {
  StudyResult r = resultOf();
  r.parts = {{"vertices", {0.5, 0.48, 0.52}},
             {"highlights", {0.1, 0.08, 0.13}},
             {"other light", {0.4, 0.38, 0.42}}};
  const std::string text = adviceText(headOf(), r);
  EXPECT_NE(text.find("vertices take 50 % (48 to 52), other light takes 40 % (38 to 42) and "
                      "highlights take 10 % (8 to 13)."),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("can save less than 13 %"), std::string::npos) << text;
}

TEST(StudyFormat, WrapsAtSpaces) {
  EXPECT_EQ(wrapped("one two three", 7), "one two\nthree");
  EXPECT_EQ(wrapped("one two three", 100), "one two three");
  EXPECT_EQ(wrapped("extraordinary x", 4), "extraordinary\nx");
  EXPECT_EQ(wrapped("", 4), "");
}

}  // namespace study_advice_test
}  // namespace glint
