// Many randomly damaged pictures.

#include "damaged_pictures.h"

namespace image_damage_long_test {

TEST(DamagedPictures, ExrIsSurvived) { glint::test::expectExrSurvived(600, true); }

TEST(DamagedPictures, HdrIsSurvived) { glint::test::expectHdrSurvived(2000); }

}  // namespace image_damage_long_test
