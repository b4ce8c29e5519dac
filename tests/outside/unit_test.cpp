#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "glint/image/matchers.h"
#include "glint/shading/fresnel.h"
#include "gradient.h"

TEST(Gradient, Same) {
  EXPECT_THAT(gradient(0), glint::MatchesBaseline(BASELINES "gradient.png", {{"max", 0}}));
  EXPECT_THAT(gradient(1), glint::LooksLike(gradient(0), {{"flip", 0.01}, {"max", 0.004}}));
  EXPECT_THAT(gradient(40), testing::Not(glint::LooksLike(gradient(0))));
}

TEST(Gradient, Planted) {
  EXPECT_THAT(gradient(40), glint::MatchesBaseline(BASELINES "gradient.png", {{"flip", 0.001}}));
}

TEST(Gradient, Missing) { EXPECT_THAT(gradient(0), glint::MatchesBaseline("made/unit.png")); }
