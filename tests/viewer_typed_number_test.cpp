#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "viewer/typed_number.h"

namespace glint::viewer {
namespace viewer_typed_number_test {

using testing::HasSubstr;

TEST(TypedNumber, ReadsWhatPeopleType) {
  const std::pair<const char*, double> cases[] = {{"0.5", 0.5},
                                                  {"0,5", 0.5},
                                                  {"1/3", 1.0 / 3},
                                                  {" 2 * (3 + 4) ", 14},
                                                  {"-2^2", -4},
                                                  {"2^3^2", 512},
                                                  {"2^-1", 0.5},
                                                  {"1e3", 1000},
                                                  {"1,5e-2", 0.015},
                                                  {"sqrt(2)", std::sqrt(2.0)},
                                                  {"pi/2", std::numbers::pi / 2},
                                                  {"10-4-3", 3},
                                                  {"8/4/2", 1},
                                                  {".25", 0.25},
                                                  {"--1", 1},
                                                  {"+7", 7}};
  for (const auto& [text, value] : cases) {
    const TypedNumber read = readTypedNumber(text, -1e9, 1e9);
    ASSERT_TRUE(read.value) << text << ": " << read.error;
    EXPECT_DOUBLE_EQ(*read.value, value) << text;
    EXPECT_EQ(read.error, "");
  }
}

TEST(TypedNumber, SaysWhatIsWrongAndClampsNothing) {
  for (const char* text : {"", "abc", "1/0", "0,5,1", "1 2", "(1", "1)", "1e", "sqrt 2", "nan",
                           "inf", "1e999", "sqrt(-1)", "2**3", "pi pi", "0x10"}) {
    const TypedNumber read = readTypedNumber(text, 0, 0);
    EXPECT_FALSE(read.value) << text;
    EXPECT_THAT(read.error, HasSubstr("number")) << text;
  }
  const TypedNumber large = readTypedNumber("1e9", 0, 1e6);
  EXPECT_FALSE(large.value);
  EXPECT_THAT(large.error, HasSubstr("from 0 to 1e+06"));
  EXPECT_FALSE(readTypedNumber("-1/3", 0, 1).value);
  EXPECT_TRUE(readTypedNumber("1e9", 0, 0).value);
}

TEST(TypedNumber, DeepTextsDoNotOverflowTheStack) {
  for (const char* part : {"(", "-", "2^", "sqrt("}) {
    std::string text;
    for (int i = 0; i < 100000; ++i) text += part;
    EXPECT_FALSE(readTypedNumber(text + "1", 0, 0).value) << part;
  }
}

}  // namespace viewer_typed_number_test
}  // namespace glint::viewer
