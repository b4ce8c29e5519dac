// Highlights widened by the lengths of a normal map's normals: the function in GLSL, a closed case,
// and pictures compared with the reference.

#include <gtest/gtest.h>

#include <cmath>

#include "glint/budget/error_budget.h"
#include "glint/reference/renderer.h"
#include "glint/render/normal_lengths.h"
#include "glint/shading/specular_filter.h"
#include "glint/study/scene.h"
#include "glsl_probe.h"
#include "stage.h"
#include "textures.h"

namespace glint::test {
namespace toksvig_gl_test {

class GlslToksvig : public GlslTest {};

// The exponent is off by two products, a sum and a division (8 u), the peak by two more sums and a
// division (15 u).
TEST_P(GlslToksvig, IsThatInDouble) {
  Column exponents, variances;
  for (double n = 0; n < 4e6; n = 1.3 * n + 0.1)
    for (double v = 1.5e-5; v <= 1; v *= 3) {
      exponents.push_back(float(n));
      variances.push_back(float(v));
    }
  for (const bool blinn : {false, true}) {
    Probe probe(glslSources(),
                {{"blocks.glsl", "parameters.glsl", "specular_filter.glsl"},
                 {{"LIGHTS", 0},
                  {"INSTANCES", 1},
                  {"VERTEX_STAGE", 1},
                  {"PARAMETER_TEXTURES", 0},
                  {"TOKSVIG", 1}},
                 std::string("#define EXPONENTS_PER_BLINN ") + (blinn ? "1.0\n" : "4.0\n")});
    const Column got = probe.run(
        "vec2 filtered(float n, float v) {\n"
        "  Parameters p = Parameters(0.0, 0.0, 1.0, n, 0.0, 0.0);\n"
        "  p = filteredParameters(p, v);\n"
        "  return vec2(p.exponent, p.specular);\n}",
        {exponents, variances});
    for (std::size_t i = 0; i < exponents.size(); ++i) {
      const FilteredLobe exact = toksvigLobe(exponents[i], blinn, variances[i]);
      EXPECT_LE(std::abs(got[2 * i] - exact.exponent), 12 * ulp1 * exact.exponent) << exponents[i];
      EXPECT_LE(std::abs(got[2 * i + 1] / exact.scale - 1), 20 * ulp1) << exponents[i];
    }
  }
}

GLINT_ON_SOFTWARE_BACKENDS(GlslToksvig);

class Toksvig : public OnStage {};

constexpr int texels = 64, across = 35;

/// A square with a map of ridges: columns that lean by one angle alternately to the right and to
/// the left.
Scene ridges(double specular, double exponent, double normalScale = 1) {
  Mesh mesh = quad({0, 0, 1}, 1);
  mesh.tangents.assign(4, {1, 0, 0, 1});
  mesh.texcoords = {{{0, 1}, {1, 1}, {1, 0}, {0, 0}}};
  Material material = materialOf(0, 0, specular, exponent);
  material.normalTexture = Texture{};
  material.normalScale = normalScale;
  Scene scene = sceneOf(mesh, material);
  const auto code = [](int x, int) {
    return glm::ivec4(x % 2 == 0 ? 128 + across : 127 - across, 128, 250, 0);
  };
  scene.images.push_back({"ridges", png(texels, texels, code), true, {}, true});
  return scene;
}

// A pixel two texels wide shows the first mip level, each of whose texels is the mean of a column
// leaning to the right and one to the left: it points to the viewer except for half a code, and
// stores their spread. So the lobe is known: n' = n / (1 + n v) about that normal. Rounding: that
// of the exact form, 1e-6 (bounds.h), and an error of 6.5e-7 in 1 - N.H times the lobe's slope.
TEST_P(Toksvig, RidgesHaveAKnownLobe) {
  // 2 texel - 1 in 255ths: for the base +-(2 across + 1), 1, 245; for the mean of 163 and 92,
  // 127.5, which rounds to 128: 1, 1, 245.
  const glm::dvec3 base(2 * across + 1, 1, 245), normal = glm::normalize(glm::dvec3(1, 1, 245));
  const double length = std::hypot(base.y, base.z) / glm::length(base);
  for (const double scale : {1.0, 0.5}) {
    const double code = normalSpreadCode(length), width = scale * (1 - code / 255);
    const glm::dvec3 n = glm::normalize(glm::dvec3(scale, scale, 1) * normal);
    for (const Shading shading : {Shading::phong, Shading::blinnPhong, Shading::environment})
      for (const double exponent : {2.0, 40.0, 1000.0})
        for (const double tilt : {0.0, 0.1, 0.4}) {
          Look look = parallelLook({0, 0, 1}, texels / 2);
          look.shading = shading;
          look.material[""].ior = 1;
          const glm::dvec3 l(std::sin(tilt), 0, std::cos(tilt)), v(0, 0, 1);
          look.light = {directional(l)};
          look.specularAntialiasing = SpecularAntialiasing::toksvig;
          const bool blinn = shading != Shading::phong;
          const double lobeExponent = blinn ? 4 * exponent : exponent;
          const FilteredLobe filtered = toksvigLobe(lobeExponent, blinn, width * width);
          const double cosine =
              blinn ? glm::dot(n, glm::normalize(l + v)) : glm::dot(2 * glm::dot(n, l) * n - l, v);
          const double expected = 0.5 * filtered.scale * std::pow(cosine, filtered.exponent);
          const Scene scene = ridges(0.5, exponent, scale);
          SCOPED_TRACE(testing::Message()
                       << shadingName(shading) << " " << exponent << " " << tilt << " " << scale);
          const double tolerance =
              2e-6 + 6.5e-7 * 0.61 * std::sqrt(filtered.exponent + 1) * (blinn ? 8 : 1);
          Scene decoded = scene;
          const DecodedImages images = decodeImages(decoded, look);
          const Image truth = ReferenceRenderer(decoded, images, boundsOf(scene), look).draw();
          EXPECT_NEAR(color(truth, 10, 13).g, expected, 1e-7);
          const Image drawn = draw(scene, look);
          for (int x = 2; x < texels / 2 - 2; ++x)
            EXPECT_NEAR(color(drawn, x, 13).g, expected, tolerance) << x;
        }
  }
}

// Under magnification, where texels are the normals themselves, nothing is widened.
TEST_P(Toksvig, NothingIsWidenedUnderMagnification) {
  const Scene scene = ridges(0.5, 40);
  Look look = parallelLook({0, 0, 1}, 2 * texels);
  look.light = {directional({0.2, 0, 1})};
  const Image plain = draw(scene, look);
  look.specularAntialiasing = SpecularAntialiasing::toksvig;
  EXPECT_LE(largestDifference(draw(scene, look), plain), 2e-6);
}

// Without a normal map there is no information about spread, nor without mip levels; nothing
// changes, not even the shader.
TEST_P(Toksvig, ChangesNothingWithoutSmallerLevels) {
  Scene scene = ridges(0.5, 40);
  Look look = parallelLook({0, 0, 1}, texels / 2);
  look.highlight = Highlight::integer;
  const auto same = [&] {
    look.specularAntialiasing = SpecularAntialiasing::none;
    const Image plain = draw(scene, look);
    look.specularAntialiasing = SpecularAntialiasing::toksvig;
    EXPECT_EQ(draw(scene, look).values, plain.values);
  };
  scene.materials[0].normalTexture->sampler.mip = MipFilter::none;
  same();
  scene.materials[0].normalTexture.reset();
  same();
}

// A scene with textures already loaded gets the lengths when a look needs them.
TEST_P(Toksvig, TexturesThatAreThereAreReplaced) {
  Scene scene = ridges(0.5, 40);
  Look look = parallelLook({0, 0, 1}, texels / 2);
  look.light = {directional({0.2, 0, 1})};
  GpuScene gpu(scene, decodeImages(scene, look));
  const Bounds bounds = boundsOf(scene);
  const Image plain = stage().renderer().draw(gpu, bounds, look);
  EXPECT_TRUE(gpu.hasImage(0, false));
  EXPECT_FALSE(gpu.hasImage(0, true));
  look.specularAntialiasing = SpecularAntialiasing::toksvig;
  gpu.addImages(decodeImages(scene, look, [&](int i, bool with) { return gpu.hasImage(i, with); }));
  EXPECT_TRUE(gpu.hasImage(0, true));
  EXPECT_EQ(stage().renderer().draw(gpu, bounds, look).values, draw(scene, look).values);
  look.specularAntialiasing = SpecularAntialiasing::none;
  EXPECT_EQ(stage().renderer().draw(gpu, bounds, look).values, plain.values);
}

// The driver's samples are off by some 1e-7 of the range 0 to 1, the width w by as much, and so
// n' by 2 n w / (1 + n w^2) times that, at most sqrt(n) times. Its normal is off likewise, and
// moves the lobe by 0.61 sqrt(n) times that; a level of detail by 2^-21, which is less. So the
// tolerance is the bound of the exact form and 4e-7 sqrt(n) for each light, except at edges.
TEST_P(Toksvig, AgreesWithTheReference) {
  const Scene scene = bumpySphereScene(materialOf(0.5, 0.5, 0.4, 20).shading);
  const DecodedImages images = bumpyImages();
  const Bounds bounds = boundsOf(scene);
  for (const Shading shading : {Shading::phong, Shading::blinnPhong, Shading::environment})
    for (const double exponent : {1.0, 20.0, 1000.0})
      for (const Normalization kind : {Normalization::none, Normalization::exact}) {
        Look look = parallelLook({0.2, 0.3, 1}, 48);
        look.shading = shading;
        look.light = {directional({0.3, 0.4, 1}), directional({-1, 0.3, 0.2}, {0.3, 0.4, 0.5})};
        look.normalization = kind;
        look.noBackground = true;
        look.material[""].exponent = exponent;
        look.specularAntialiasing = SpecularAntialiasing::toksvig;
        look.maxError = 0;
        const double bound = resolveLook(scene, bounds, look).bound;
        look.maxError.reset();
        const bool blinn = usesBlinn(shading);
        const double n = blinn ? 4 * exponent : exponent;
        const double tolerance =
            bound + 2e-6 + 2 * 4e-7 * std::sqrt(4 * n) * 0.4 * lobeNormalization(kind, blinn, n);
        GpuScene gpu(scene, images);
        const Image drawn = stage().renderer().draw(gpu, bounds, look);
        const Image truth = ReferenceRenderer(scene, images, bounds, look).draw();
        look.specularAntialiasing = SpecularAntialiasing::none;
        const Image plain = ReferenceRenderer(scene, images, bounds, look).draw();
        int off = 0, shown = 0, changed = 0;
        for (int y = 0; y < 48; ++y)
          for (int x = 0; x < 48; ++x) {
            const glm::dvec3 d = glm::abs(color(drawn, x, y) - color(truth, x, y));
            shown += pixel(truth, x, y).a > 0;
            off += !(std::max({d.x, d.y, d.z}) <= tolerance);
            changed += glm::length(color(plain, x, y) - color(truth, x, y)) > 0.01;
          }
        EXPECT_GT(shown, 1000);
        EXPECT_GT(changed, exponent == 20 ? 50 : 3);
        EXPECT_LE(off, shown / 40) << shadingName(shading) << " " << exponent << " " << int(kind);
      }
}

INSTANTIATE_TEST_SUITE_P(Software, Toksvig, softwareBackends(), nameOfBackend);

}  // namespace toksvig_gl_test
}  // namespace glint::test
