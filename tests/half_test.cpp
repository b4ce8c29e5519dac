// Half floats in software: all 65,536 of them, and the forms of the lobe computed with them.

#include "glint/shading/half.h"

#include <Imath/half.h>
#include <gtest/gtest.h>

#include <cmath>

#include "glint/shading/bounds.h"
#include "glint/shading/lobe.h"
#include "glint/study/half_forms.h"

namespace glint {
namespace half_test {

// Compared with OpenEXR's half: every value, and the midpoints between neighbours and the floats
// next to them.
TEST(Half, AllValuesAndTheirMiddlesAreThoseOfOpenExr) {
  for (int bits = 0; bits <= 0xffff; ++bits) {
    const auto each = std::uint16_t(bits);
    Imath::half other;
    other.setBits(each);
    const double value = halfValue(each);
    if (other.isNan()) {
      EXPECT_TRUE(std::isnan(value)) << bits;
      continue;
    }
    EXPECT_EQ(value, double(float(other))) << bits;
    EXPECT_EQ(halfBits(value), each) << bits;
    if ((each & 0x7fff) >= 0x7bff) continue;  // the next value is infinite
    const double next = halfValue(std::uint16_t(bits + 1)), middle = 0.5 * (value + next);
    for (const double x : {middle, std::nextafter(float(middle), 0.0f) * 1.0,
                           std::nextafter(float(middle), float(2 * next)) * 1.0})
      EXPECT_EQ(halfBits(x), Imath::half(float(x)).bits()) << bits << " " << x;
  }
}

// Ties go to even: checked independently of another program, too.
TEST(Half, TiesGoToEvenAndOverflowToInfinity) {
  for (int bits = 0; bits < 0x7bff; ++bits) {
    const double middle =
        0.5 * (halfValue(std::uint16_t(bits)) + halfValue(std::uint16_t(bits + 1)));
    EXPECT_EQ(halfBits(middle), bits + (bits & 1)) << bits;
    EXPECT_EQ(halfBits(-middle), 0x8000 | (bits + (bits & 1))) << bits;
  }
  EXPECT_EQ(halfBits(65519.99), 0x7bff);
  EXPECT_EQ(halfBits(65520), 0x7c00);
  EXPECT_EQ(halfBits(1e300), 0x7c00);
  EXPECT_EQ(halfBits(0x1p-25), 0);
  EXPECT_EQ(halfBits(std::nextafter(0x1p-25, 1.0)), 1);
  EXPECT_EQ(halfBits(-0.0), 0x8000);
  EXPECT_EQ(halfBits(std::nan("")) & 0x7fff, 0x7e00);
}

// A cosine within 2^-12 of 1 rounds to 1: pow then draws 1 for (1 - 2^-12)^alpha.
TEST(HalfForms, PowLosesTheCosineNextToThePeak) {
  for (const double alpha : {16.0, 100.0, 1000.0}) {
    const HalfError error = halfErrorOf(Highlight::pow, 0, alpha);
    EXPECT_LT(error.formula, 1e-10);
    EXPECT_GE(error.half, 0.99 * (1 - std::pow(1 - 0x1p-12, alpha)));
  }
  EXPECT_GT(halfErrorOf(Highlight::pow, 0, 10000).half, 0.5);
}

// Lambda's halves are fine enough near 0: rounding it moves a lobe by at most
// 2^-11 alpha lambda exp(-alpha lambda) <= 2^-11 / e. Three operations and g squarings follow, each
// with an error of at most 2^-11, whose sum g + 2 squarings multiply.
TEST(HalfForms, SquaringFromLambdaHoldsForEveryExponent) {
  for (const int gamma : {1, 4, 16})
    for (const double alpha : {20.0, 100.0, 1000.0, 10000.0}) {
      const HalfError error = halfErrorOf(Highlight::lyon, gamma, alpha);
      EXPECT_LE(error.half, error.formula + (4 + 2 * gamma) * 0x1p-11) << gamma << " " << alpha;
    }
}

// The form's own error is within its bound at the halves tested.
TEST(HalfForms, FormulasAreWithinTheirBounds) {
  for (const HighlightRow& form : highlightRows()) {
    const int gamma = form.hasGamma() ? 8 * form.leastGamma : 1;
    for (const double alpha : {5.0, 40.0, 1000.0}) {
      if (form.wholePowers && !isIntegerPower(alpha)) continue;
      const double bound = lobeFormulaBound(form.form, gamma, alpha);
      EXPECT_LE(halfErrorOf(form.form, gamma, alpha).formula, bound * 1.001 + 1e-12) << form.name;
    }
  }
}

TEST(HalfForms, TheTableHasARowForEachForm) {
  const std::string table = halfTable();
  for (const char* form : {"`exact`", "`pow`", "`integer`", "`lyon:4`", "`lyon-tuned:16`",
                           "`lyon-cross:64`", "`pade:16`", "`gaussian`"})
    EXPECT_NE(table.find(form), std::string::npos) << form;
  EXPECT_EQ(table.find("nan"), std::string::npos);
  EXPECT_LT(holdsUpTo(Highlight::pow, 0), 20);
  EXPECT_GE(holdsUpTo(Highlight::gaussian, 0), 1000);
}

}  // namespace half_test
}  // namespace glint
