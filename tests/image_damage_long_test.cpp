// Many pictures damaged at random.

#include "damaged_pictures.h"

namespace {

TEST(DamagedPictures, ExrIsSurvived) { glint::test::expectExrSurvived(600, true); }

TEST(DamagedPictures, HdrIsSurvived) { glint::test::expectHdrSurvived(2000); }

}  // namespace
