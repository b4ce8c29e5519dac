#include <gtest/gtest.h>

#include "glint/image/image.h"

namespace image_values_test {

TEST(Image, RowsFollowEachOther) {
  glint::Image image{3, 2, std::vector<float>(24)};
  EXPECT_EQ(image.row(1) - image.row(0), 12);
}

}  // namespace image_values_test
