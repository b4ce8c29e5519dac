// The probe itself: values pass through unchanged, for every type of argument and result, in any
// number.

#include <gmock/gmock.h>

#include <bit>
#include <cmath>
#include <limits>

#include "glint/image/error.h"
#include "glsl_probe.h"

namespace glint::glsl_probe_gl_test {

using testing::HasSubstr;

class GlslProbe : public GlslTest {};

std::string errorOf(Probe& probe, std::string_view function, const Columns& columns) {
  try {
    probe.run(function, columns);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST_P(GlslProbe, PassesFloatsBitByBit) {
  Probe probe;
  // Every 4099th bit pattern of finite, normal floats, and zeros and infinities.
  Column in{0.0f, -0.0f, INFINITY, -INFINITY, 1e-38f * 1.18f, 3.4e38f};
  for (std::uint32_t bits = 0x00800000; bits < 0x7f800000; bits += 4099) {
    in.push_back(std::bit_cast<float>(bits));
    in.push_back(-in.back());
  }
  const Column out = probe.run("float same(float x) { return x; }", {in});
  ASSERT_EQ(out.size(), in.size());
  for (std::size_t i = 0; i < in.size(); ++i)
    ASSERT_EQ(std::bit_cast<std::uint32_t>(out[i]), std::bit_cast<std::uint32_t>(in[i])) << in[i];
  const Column nan{std::numeric_limits<float>::quiet_NaN()};
  EXPECT_TRUE(std::isnan(probe.run("float same(float x) { return x; }", {nan})[0]));
}

TEST_P(GlslProbe, TakesEveryTypeOfArgumentAndResult) {
  Probe probe(glslSources(), {{"fresnel.glsl"}, {{"DENSER_SIDE", 1}}});
  const Column ones{1, 2, 3}, twos{1, 2, 3, 4, 5, 6}, threes{1, 2, 3, 4, 5, 6, 7, 8, 9},
      fours{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
  EXPECT_EQ(probe.run("float f(float x) { return 2.0 * x; }", {ones}), (Column{2, 4, 6}));
  EXPECT_EQ(probe.run("vec2 f(vec2 x) { return x.yx; }", {twos}), (Column{2, 1, 4, 3, 6, 5}));
  EXPECT_EQ(probe.run("vec3 f(vec3 x) { return x.zyx; }", {threes}),
            (Column{3, 2, 1, 6, 5, 4, 9, 8, 7}));
  EXPECT_EQ(probe.run("vec4 f(const in vec4 x, float y) { return x * y; }", {fours, ones}),
            (Column{1, 2, 3, 4, 10, 12, 14, 16, 27, 30, 33, 36}));
  EXPECT_EQ(
      probe.run("vec4 f(Boundary b) { return vec4(b.criticalRest, b.critical, b.square, b.e); }",
                {std::span(fours).first(8)}),
      (Column{4, 3, 2, 1, 8, 7, 6, 5}));
  // By name only: built-in functions, and those in a file. A column with one row applies to all.
  EXPECT_EQ(probe.run("float max(float, float)", {ones, Column{2}}), (Column{2, 2, 3}));
  EXPECT_EQ(probe.run("float fresnelExact(float, Boundary)", {ones, Column{0, 1, 1, 0}}),
            (Column{0, 0, 0}));
  EXPECT_EQ(probe.run("float one() { return 1.0; }", {}), (Column{1}));
  EXPECT_TRUE(probe.run("float abs(float)", {Column{}}).empty());
}

TEST_P(GlslProbe, KeepsRowsApartInBatches) {
  Probe probe;
  // Several batches, rows of the target, and half a row.
  Column in((std::size_t(1) << 20) + 3 * 1024 + 511);
  for (std::size_t i = 0; i < in.size(); ++i) in[i] = float(i);
  const Column out = probe.run("float f(float x) { return x + 1.0; }", {in});
  ASSERT_EQ(out.size(), in.size());
  for (std::size_t i = 0; i < in.size(); ++i) ASSERT_EQ(out[i], in[i] + 1);
  const Column three = probe.run("vec3 f(float x) { return vec3(x, -x, 0.5 * x); }", {in});
  ASSERT_EQ(three.size(), 3 * in.size());
  for (std::size_t i = 0; i < in.size(); ++i) {
    ASSERT_EQ(three[3 * i], in[i]);
    ASSERT_EQ(three[3 * i + 1], -in[i]);
    ASSERT_EQ(three[3 * i + 2], 0.5f * in[i]);
  }
}

TEST_P(GlslProbe, DefinesChooseTheText) {
  Probe white({}, {{"vector.glsl", "environment_map.glsl"},
                   {{"ENVIRONMENT_STUDIO", 0},
                    {"ENVIRONMENT_SKY", 1},
                    {"ENVIRONMENT_WHITE", 2},
                    {"ENVIRONMENT_MAP", 2}}});
  EXPECT_EQ(white.run("vec3 environmentRadiance(vec3)", {Column{0, 1, 0}}), (Column{1, 1, 1}));
}

TEST_P(GlslProbe, SaysWhatIsWrong) {
  Probe probe(glslSources(), {{"lobe.glsl"}, {}});
  EXPECT_THAT(errorOf(probe, "lobeExact", {}), HasSubstr("is not a prototype"));
  EXPECT_THAT(errorOf(probe, "int f(float)", {Column{1}}), HasSubstr("gives a int"));
  EXPECT_THAT(errorOf(probe, "float f(mat3)", {Column{1}}), HasSubstr("takes a mat3"));
  EXPECT_THAT(errorOf(probe, "float lobeExact(float, float)", {Column{1}}),
              HasSubstr("lobeExact takes 2 columns, not 1"));
  EXPECT_THAT(errorOf(probe, "float lobeExact(float, float)", {Column{1, 2}, Column{1, 2, 3}}),
              HasSubstr("column 2 of lobeExact has 3 floats"));
  EXPECT_THAT(errorOf(probe, "float length(vec2)", {Column{1, 2, 3}}),
              HasSubstr("column 1 of length has 3 floats: it takes 2"));
  EXPECT_THAT(errorOf(probe, "float nothing(float)", {Column{1}}), HasSubstr("nothing"));
  Column short1(1);
  EXPECT_THROW(probe.run("float abs(float)", {Column{1, 2}}, short1), Error);
}

TEST_P(GlslProbe, FindsAPlantedError) {
  Probe probe;
  // A bump of 1e-5 at 0.3, one thousandth wide, on an otherwise exact function.
  const char* function = "float f(float x) { return x + max(1e-5 - 1e-2 * abs(x - 0.3), 0.0); }";
  const SearchResult worst = huntWorst(
      {{0, 1, {}}},
      [&](const std::vector<Column>& columns) {
        const Column got = probe.run(function, {columns[0]});
        std::vector<double> errors;
        for (std::size_t i = 0; i < got.size(); ++i)
          errors.push_back(absoluteError(got[i], columns[0][i]));
        return errors;
      },
      1 << 12, 8);
  EXPECT_NEAR(worst.error, 1e-5, 1e-7);
  EXPECT_NEAR(worst.input[0], 0.3, 1e-5);
}

GLINT_ON_SOFTWARE_BACKENDS(GlslProbe);

TEST(ProbeError, CountsInFloats) {
  EXPECT_EQ(floatSpacing(1.0), std::ldexp(1.0, -23));
  EXPECT_EQ(floatSpacing(-1.99), std::ldexp(1.0, -23));
  EXPECT_EQ(floatSpacing(2.0), std::ldexp(1.0, -22));
  EXPECT_EQ(floatSpacing(0.0), std::ldexp(1.0, -149));
  EXPECT_EQ(floatSpacing(1e-40), std::ldexp(1.0, -149));

  ErrorRecord record;
  record.add(1.0f, 1.0, 0, 0);
  record.add(INFINITY, INFINITY, 0, 1);
  EXPECT_EQ(record.outside, 0u);
  record.add(1.0f, 1.0 + std::ldexp(1.5, -23), std::ldexp(1.0, -22), 2);
  EXPECT_EQ(record.absolute.value, std::ldexp(1.5, -23));
  EXPECT_EQ(record.ulp.value, 1.5);
  EXPECT_EQ(record.ofBound.value, 0.75);
  EXPECT_EQ(record.outside, 0u);
  record.add(NAN, 1.0, 1e30, 3);
  EXPECT_EQ(record.outside, 1u);
  EXPECT_EQ(record.notFinite, 1u);
  EXPECT_EQ(record.absolute.row, 3u);
  EXPECT_EQ(record.values, 4u);
}

TEST(ProbeSearch, OrdersFloats) {
  for (float x : {-INFINITY, -1.0f, -1e-45f, 0.0f, 1e-45f, 1.0f, 3e38f})
    EXPECT_EQ(floatAtOrder(floatOrder(x)), x);
  EXPECT_EQ(floatOrder(-0.0f), floatOrder(0.0f));
  EXPECT_EQ(stepFloat(0.0f, -1), -1e-45f);
  EXPECT_EQ(stepFloat(1.0f, 1), std::nextafter(1.0f, 2.0f));
  EXPECT_EQ(stepFloat(3e38f, 1 << 30), INFINITY);
}

}  // namespace glint::glsl_probe_gl_test
