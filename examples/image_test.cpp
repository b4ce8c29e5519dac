// Compares the picture drawn by the driver with the one drawn in double precision on the CPU.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "glint/glint.h"
#include "glint/image/matchers.h"

TEST(Teapot, LooksLikeTheReference) {
  const glint::Model model = glint::Model::load(MODEL);
  const glint::Options look{{"resolution", "128,128"}, {"anti-aliasing", "none"}};
  glint::Session driver, reference("reference");
  // At edges a driver may give a pixel to either side, so the mean is more telling than the
  // maximum.
  EXPECT_THAT(driver.draw(model, look),
              glint::LooksLike(reference.draw(model, look), {{"mean", 1e-4}, {"flip", 1e-3}}));
}
