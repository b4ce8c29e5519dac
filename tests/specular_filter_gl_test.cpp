// Specular anti-aliasing and normalised highlights: their functions in GLSL, pictures compared with
// the reference, and a highlight smaller than a pixel with a known mean.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "glint/budget/error_budget.h"
#include "glint/reference/renderer.h"
#include "glint/scene/look_text.h"
#include "glint/shading/normalization.h"
#include "glint/shading/specular_filter.h"
#include "glsl_probe.h"
#include "stage.h"

namespace glint::test {
namespace specular_filter_gl_test {

using std::numbers::pi;

class GlslFactors : public GlslTest {};

// Two or three roundings each, and a division (5 u). Blinn-Phong's exact one also has a power of
// two, which is off by 3 + 2 |x| in 2^-23 of its value (at most 6 u of the difference, which is at
// least 1).
TEST_P(GlslFactors, NormalizationsAreThoseInDouble) {
  Probe probe(glslSources(), {{"normalization.glsl"}, {}});
  Column exponents{0};
  for (double n = 1e-3; n < 4e6; n *= 1.07) exponents.push_back(float(n));
  for (const Normalization kind : {Normalization::simple, Normalization::exact})
    for (const bool blinn : {false, true}) {
      const Column got = probe.run(
          "float " + std::string(normalizationGlsl(kind, blinn)) + "(float)", {exponents});
      for (std::size_t i = 0; i < got.size(); ++i) {
        const double exact = lobeNormalization(kind, blinn, exponents[i]);
        EXPECT_LE(std::abs(got[i] / exact - 1), 20 * ulp1) << exponents[i];
      }
    }
}

// w = 1 / a^2 and w / (1 + w k) take five operations and a division, together at most 12 u;
// subtracting 1 makes it an error of 12 u (n + 2) in the exponent.
TEST_P(GlslFactors, TheFilterIsThatInDouble) {
  Column exponents, turns;
  for (double n = 0; n < 4e6; n = 1.3 * n + 0.1)
    for (double turn = 1e-9; turn < 10; turn *= 3) {
      exponents.push_back(float(n));
      turns.push_back(float(turn));
    }
  for (const bool blinn : {false, true}) {
    const std::string defines =
        "#define PIXEL_VARIANCE 0.159154943\n#define LARGEST_WIDENING 0.18\n"
        "#define EXPONENTS_PER_BLINN " +
        std::string(blinn ? "1.0" : "4.0") + "\n";
    Probe probe(glslSources(), {{"blocks.glsl", "parameters.glsl", "specular_filter.glsl"},
                                {{"LIGHTS", 0},
                                 {"INSTANCES", 1},
                                 {"VERTEX_STAGE", 1},
                                 {"PARAMETER_TEXTURES", 0},
                                 {"TOKSVIG", 0}},
                                defines});
    const Column got = probe.run(
        "vec2 filtered(float n, float turn) {\n"
        "  Parameters p = Parameters(0.0, 0.0, 1.0, n, 0.0, 0.0);\n"
        "  p = filteredParameters(p, turn);\n"
        "  return vec2(p.exponent, p.specular);\n}",
        {exponents, turns});
    for (std::size_t i = 0; i < exponents.size(); ++i) {
      const FilteredLobe exact = filteredLobe(exponents[i], blinn, turns[i]);
      EXPECT_LE(std::abs(got[2 * i] - exact.exponent), 16 * ulp1 * (exact.exponent + 2))
          << exponents[i] << " " << turns[i];
      EXPECT_LE(std::abs(got[2 * i + 1] / exact.scale - 1), 16 * ulp1) << exponents[i];
    }
  }
}

GLINT_ON_SOFTWARE_BACKENDS(GlslFactors);

class SpecularFilter : public OnStage {};

/// A flat sheet with the normals of a sphere of the radius `radius` (pixels) around the point
/// `center` of the picture (pixels from its middle): N = (x, y) / radius exactly at the vertices,
/// which are a pixel apart. One unit is a pixel.
Mesh lens(double radius, const glm::dvec2& center, int size) {
  Mesh mesh;
  const int half = size / 2;
  for (int y = -half; y <= half; ++y)
    for (int x = -half; x <= half; ++x) {
      mesh.positions.emplace_back(float(x), float(y), 0.0f);
      const glm::dvec2 slope = (glm::dvec2(x, y) - center) / radius;
      mesh.normals.emplace_back(glm::vec3(slope.x, slope.y, std::sqrt(1 - glm::dot(slope, slope))));
    }
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const auto at = [&](int i, int j) { return std::uint32_t((y + j) * (size + 1) + x + i); };
      mesh.indices.insert(mesh.indices.end(),
                          {at(0, 0), at(1, 0), at(1, 1), at(0, 0), at(1, 1), at(0, 1)});
    }
  return mesh;
}

Look lensLook(Shading shading, int size) {
  Look look = parallelLook({0, 0, 1}, size);
  look.cameraPosition = glm::dvec3(0, 0, 100);
  look.cameraViewAngle = 2 * std::atan(size / 2.0 / 100) / degrees;
  look.light = {directional({0, 0, 1})};
  look.shading = shading;
  return look;
}

double sumOf(const Image& image) {
  double sum = 0;
  for (std::size_t i = 0; i < image.values.size(); i += 4) sum += double(image.values[i]);
  return sum;
}

// Under light along the view, the highlight (N.H)^n of such a sphere of radius r has the total
//     2 pi r^2 integral of (1 - s^2)^(n/2) s ds = 2 pi r^2 / (n + 2)   pixels of m_s,
// and Phong's, (1 - 2 s^2)^a, pi r^2 / (2 (a + 1)). Here it is a quarter of a pixel wide: samples
// at pixel centres hit or miss it. Filtered, its variance is more than 1 / pi pixels^2, so that the
// sum of its samples, wherever it lies between them, is off by at most 4 exp(-2 pi^2 / pi) = 0.8 %
// (Poisson summation). Its tail is dimmed with it.
TEST_P(SpecularFilter, AHighlightSmallerThanAPixelHasItsMean) {
  constexpr int size = 32;
  constexpr double radius = 64, exponent = 16384;
  for (const Shading shading : {Shading::phong, Shading::blinnPhong}) {
    const double mean = shading == Shading::phong ? pi * radius * radius / (2 * (exponent + 1))
                                                  : 2 * pi * radius * radius / (4 * exponent + 2);
    double least = 1e9, most = 0;
    for (const glm::dvec2 place : {glm::dvec2(0.5, 0.5), {0, 0}, {0.25, 0.125}, {-0.4, 0.9}}) {
      const Scene scene = sceneOf(lens(radius, place, size), materialOf(0, 0, 1, exponent));
      Look look = lensLook(shading, size);
      const double single = sumOf(draw(scene, look));
      least = std::min(least, single);
      most = std::max(most, single);
      look.specularAntialiasing = SpecularAntialiasing::kaplanyan;
      EXPECT_NEAR(sumOf(draw(scene, look)) / mean, 1, 0.01)
          << shadingName(shading) << " at " << place.x << "," << place.y;
      // The truth, from 16 x 16 unfiltered samples per pixel, and from the reference's own.
      look.specularAntialiasing = SpecularAntialiasing::none;
      look.antiAliasing = {AntiAliasing::Mode::ssaa, 16};
      EXPECT_NEAR(sumOf(ReferenceRenderer(scene, {}, boundsOf(scene), look).draw()) / mean, 1,
                  0.01);
    }
    EXPECT_LT(least, 0.2 * mean) << shadingName(shading);
    EXPECT_GT(most, 2 * mean) << shadingName(shading);
  }
}

// Pictures compared with the reference, which filters by its own normals in double. The bound of
// the exact form (--max-error 0) covers rounding. The driver's interpolation of normals, 1e-6,
// moves the lobe by 0.61 sqrt(n) 1e-6 and the filter by half as much again. A sample within 1/256
// of an edge may belong to the adjacent triangle for the driver, which snaps vertices, and normals
// change differently there, as they do outside of an outline: of some 1000 pixels, each with edges
// of one or two pixels' length, this affects one or two in a hundred, and twice that with four
// samples.
TEST_P(SpecularFilter, AgreesWithTheReference) {
  const AntiAliasing samples[] = {
      {AntiAliasing::Mode::none, 1}, {AntiAliasing::Mode::msaa, 4}, {AntiAliasing::Mode::ssaa, 2}};
  for (const Shading shading : {Shading::phong, Shading::blinnPhong, Shading::environment})
    for (const double exponent : {5.0, 200.0, 10000.0})
      for (const AntiAliasing& each : samples)
        for (const Normalization kind : {Normalization::none, Normalization::exact}) {
          const Scene scene = sceneOf(sphere(48, 24), materialOf(0.5, 0.5, 0.4, exponent, 0.5));
          Look look = parallelLook({0.2, 0.3, 1}, 48);
          look.cameraOrthographic = false;
          look.cameraViewAngle = 30;
          look.light = {directional({0.3, 0.4, 1}), directional({-1, 0.3, 0.2}, {0.3, 0.4, 0.5})};
          look.shading = shading;
          look.antiAliasing = each;
          look.normalization = kind;
          look.specularAntialiasing = SpecularAntialiasing::kaplanyan;
          look.noBackground = true;
          look.maxError = 0;
          const double bound = resolveLook(scene, boundsOf(scene), look).bound;
          look.maxError.reset();
          const double strength =
              0.4 * lobeNormalization(kind, usesBlinn(shading),
                                      usesBlinn(shading) ? 4 * exponent : exponent);
          const double tolerance =
              2 * bound + 1e-6 * (1 + strength * 2 * std::sqrt(4 * exponent)) * 2;
          const Image drawn = draw(scene, look);
          ReferenceRenderer reference(scene, {}, boundsOf(scene), look);
          const Image truth = reference.draw();
          int off = 0, shown = 0;
          for (int y = 0; y < 48; ++y)
            for (int x = 0; x < 48; ++x) {
              const glm::dvec3 d = glm::abs(color(drawn, x, y) - color(truth, x, y));
              shown += pixel(truth, x, y).a > 0;
              off += !(std::max({d.x, d.y, d.z}) <= tolerance);
            }
          EXPECT_GT(shown, 1000);
          EXPECT_LE(off, shown / 40)
              << shadingName(shading) << " " << exponent << " " << each.count << " " << int(kind);
        }
}

// Compared with the supersampled picture without a filter, which is the filter's purpose.
TEST_P(SpecularFilter, IsNearerToTheSupersampledPicture) {
  const Scene scene = sceneOf(sphere(96, 48), materialOf(0, 0, 1, 10000));
  for (const Shading shading : {Shading::phong, Shading::blinnPhong}) {
    Look look = parallelLook({0.2, 0.3, 1}, 64);
    look.light = {directional({0.3, 0.4, 1}), directional({-0.3, 0.8, 1}),
                  directional({0, -0.3, 1}), directional({-0.5, -0.3, 1})};
    look.shading = shading;
    const auto drawn = [&](bool filtered) {
      look.specularAntialiasing =
          filtered ? SpecularAntialiasing::kaplanyan : SpecularAntialiasing::none;
      return draw(scene, look);
    };
    const Image plain = drawn(false), filtered = drawn(true);
    Look fine = look;
    fine.specularAntialiasing = SpecularAntialiasing::none;
    fine.antiAliasing = {AntiAliasing::Mode::ssaa, 16};
    const Image truth = ReferenceRenderer(scene, {}, boundsOf(scene), fine).draw();
    const auto error = [&](const Image& image) {
      double squares = 0;
      for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
          const glm::dvec3 d = color(image, x, y) - color(truth, x, y);
          squares += glm::dot(d, d);
        }
      return std::sqrt(squares);
    };
    // No nearer than its kernel, which on a sphere is wider than a pixel, allows.
    EXPECT_LT(error(filtered), 0.75 * error(plain)) << shadingName(shading);
  }
}

// Shading per face or per vertex has no information about a pixel.
TEST_P(SpecularFilter, ChangesNothingPerFaceAndVertex) {
  const Scene scene = sceneOf(sphere(24, 12), materialOf(0.5, 0.5, 0.4, 1000));
  for (const Shading shading : {Shading::flat, Shading::gouraud}) {
    Look look = parallelLook({0.2, 0.3, 1}, 32);
    look.shading = shading;
    const Image plain = draw(scene, look);
    look.specularAntialiasing = SpecularAntialiasing::kaplanyan;
    EXPECT_EQ(draw(scene, look).values, plain.values) << shadingName(shading);
  }
}

INSTANTIATE_TEST_SUITE_P(Software, SpecularFilter, softwareBackends(), nameOfBackend);

}  // namespace specular_filter_gl_test
}  // namespace glint::test
