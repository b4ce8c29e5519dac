// Textures for material parameters: a texel acts locally like a factor acts globally, so a texture
// with one value gives the same picture as that factor.

#include <gtest/gtest.h>

#include "formulas.h"
#include "glint/reference/renderer.h"
#include "glint/scene/look_text.h"
#include "glint/shading/pbr_conversion.h"
#include "stage.h"
#include "textures.h"

namespace glint::test {
namespace parameter_textures_gl_test {

constexpr Shading programs[] = {Shading::flat, Shading::gouraud, Shading::phong,
                                Shading::blinnPhong, Shading::environment};

class ParameterTexture : public OnStage {};

/// The glTF parameters of a material, and its texels.
struct Wanted {
  double metallic = 1, roughness = 1, strength = 1, specular = 1, transmission = 0;
  glm::ivec4 texel{255};  ///< R occlusion or transmission, G roughness, B metallic, A specular
};

Material plainMaterial(const PbrParameters& pbr) {
  const ConvertedParameters c = convertPbr(pbr);
  Material m;
  m.shading = {c.ambient, c.diffuse, c.specular, c.exponent, c.metalness, c.ior, {0.8, 0.5, 0.2}};
  m.highlightShare = c.share;
  return m;
}

/// Without a texture: the texels multiplied into the factors.
Material factored(const Wanted& w) {
  const glm::dvec4 t = glm::dvec4(w.texel) / 255.0;
  Material m = plainMaterial({w.metallic * t.b, w.roughness * t.g, 1.5, w.specular * t.a});
  m.shading.ambient = 1 + w.strength * (t.r - 1);
  m.shading.transmission = w.transmission * t.r;
  return m;
}

Texture nearest(int image) {
  Texture texture;
  texture.image = image;
  texture.sampler = {Filter::nearest, Filter::nearest, MipFilter::none, Wrap::clampToEdge,
                     Wrap::clampToEdge};
  return texture;
}

Material textured(const Wanted& w) {
  const PbrParameters pbr{w.metallic, w.roughness, 1.5, w.specular};
  Material m = plainMaterial(pbr);
  m.shading.transmission = w.transmission;
  ParameterTextures& p = m.parameterTextures;
  p.metallic = w.metallic;
  p.roughness = w.roughness;
  p.reflectance = dielectricReflectance(pbr);
  p.occlusionStrength = w.strength;
  p.metallicRoughness = p.occlusion = p.specular = p.transmission = nearest(0);
  m.textured = textured::ambient | textured::diffuse | textured::specular | textured::exponent |
               textured::metalness | textured::transmission;
  return m;
}

Mesh ball() {
  Mesh mesh = sphere(24, 12);
  mesh.texcoords.resize(1);
  for (const glm::vec3& p : mesh.positions)
    mesh.texcoords[0].emplace_back(0.5f + 0.5f * p.x, 0.5f - 0.5f * p.y);
  return mesh;
}

Scene sceneWith(const Material& material, const std::vector<std::byte>& image) {
  Scene scene = sceneOf(ball(), material);
  scene.images.push_back({"numbers", image, true});
  return scene;
}

Look lookFor(Shading shading) {
  Look look = parallelLook({0.1, 0.2, 1}, 48);
  look.cameraOrthographic = false;
  look.cameraViewAngle = 35;
  look.shading = shading;
  look.ambientLight = glm::dvec3(0.25);
  look.light = {directional({0.3, 0.4, 1}), directional({-1, 0.2, 0.4}, {0.3, 0.5, 0.7})};
  return look;
}

// The fourth power of the roughness takes 8 roundings, which the steepest lobe here (4 x 4999.5)
// turns into 8 x 2^-24 / e of its height, for the highlights of two lights: below 1e-6. Lobes whose
// exponents differ by that are at most 2e-6 apart.
TEST_P(ParameterTexture, ATexelIsAFactor) {
  const Wanted all[] = {
      {},
      {1, 1, 1, 1, 0.5, {128, 77, 255, 255}},
      {1, 0.5, 0.5, 1, 1, {51, 153, 0, 128}},
      {0.7, 0.9, 1, 0.6, 0.25, {255, 20, 100, 60}},
      {0, 0.3, 0, 1, 0, {0, 255, 255, 255}},
  };
  for (const Wanted& w : all)
    for (const Shading shading : programs)
      for (const char* form : {"exact", "lyon-tuned:8", "pade:4", "gaussian", "lyon-cross:4"}) {
        Look look = lookFor(shading);
        look.highlight = parseHighlights(form, "form");
        const auto one = png(1, 1, [&](int, int) { return w.texel; });
        const Image plain = draw(sceneWith(factored(w), one), look);
        const Image drawn = draw(sceneWith(textured(w), one), look);
        EXPECT_LE(largestDifference(plain, drawn), 4e-6)
            << shadingName(shading) << " " << form << " roughness " << w.texel.g;
      }
}

// The same for normalised highlights, whose factor the shader computes if a texture gives the
// exponent: relative to their height, which is up to m_s (alpha + 2) / 2 for Phong.
TEST_P(ParameterTexture, ATexelIsAFactorOfANormalisedHighlight) {
  const Wanted all[] = {{},
                        {1, 1, 1, 1, 0.5, {128, 77, 255, 255}},
                        {0.7, 0.9, 1, 0.6, 0.25, {255, 60, 100, 60}},
                        {0, 0.3, 0, 1, 0, {0, 255, 255, 255}}};
  for (const Wanted& w : all)
    for (const Shading shading : programs)
      for (const Normalization kind : {Normalization::simple, Normalization::exact}) {
        Look look = lookFor(shading);
        look.normalization = kind;
        const auto one = png(1, 1, [&](int, int) { return w.texel; });
        const Material material = factored(w);
        const Image plain = draw(sceneWith(material, one), look);
        const Image drawn = draw(sceneWith(textured(w), one), look);
        const double height = *material.highlightShare * (0.5 * material.shading.exponent + 1);
        EXPECT_LE(largestDifference(plain, drawn), 4e-6 * std::max(height, 1.0))
            << shadingName(shading) << " roughness " << w.texel.g;
        Look notes = look;
        notes.normalization = Normalization::none;
        EXPECT_GT(largestDifference(plain, draw(sceneWith(material, one), notes)), 1e-3);
      }
}

// A texture with two halves: in a per-pixel program each pixel shows its own texel.
TEST_P(ParameterTexture, PixelsShowTheirOwnTexels) {
  const glm::ivec4 left(60, 90, 255, 255), right(255, 200, 0, 200);
  const auto halves = png(2, 1, [&](int x, int) { return x == 0 ? left : right; });
  for (const Shading shading : {Shading::phong, Shading::blinnPhong, Shading::environment}) {
    const Look look = lookFor(shading);
    const Image drawn = draw(sceneWith(textured({1, 1, 1, 1, 0.5}), halves), look);
    const Image atLeft = draw(sceneWith(factored({1, 1, 1, 1, 0.5, left}), halves), look);
    const Image atRight = draw(sceneWith(factored({1, 1, 1, 1, 0.5, right}), halves), look);
    int ofLeft = 0, ofRight = 0, ofNone = 0;
    for (int y = 0; y < 48; ++y)
      for (int x = 0; x < 48; ++x) {
        const auto near = [&](const Image& other) {
          const glm::dvec3 d = glm::abs(color(drawn, x, y) - color(other, x, y));
          return std::max({d.x, d.y, d.z}) <= 4e-6;
        };
        const bool isLeft = near(atLeft), isRight = near(atRight);
        ofLeft += isLeft && !isRight;
        ofRight += isRight && !isLeft;
        ofNone += !isLeft && !isRight;
      }
    EXPECT_GT(ofLeft, 300) << shadingName(shading);
    EXPECT_GT(ofRight, 300) << shadingName(shading);
    EXPECT_EQ(ofNone, 0) << shadingName(shading);
  }
}

// A value in the look replaces the texture.
TEST_P(ParameterTexture, GivenNumbersTakeTheTexturesPlace) {
  const auto texels =
      png(2, 2, [](int x, int y) { return glm::ivec4(200 * x, 90 + 60 * y, 255, 9); });
  for (const Shading shading : programs) {
    Look look = lookFor(shading);
    MaterialEdit& edit = look.material[""];
    edit.ambient = 0.5;
    edit.diffuse = 0.7;
    edit.specular = 0.4;
    edit.exponent = 25;
    edit.metalness = 0.3;
    edit.transmission = 0.2;
    const Image given = draw(sceneWith(textured({}), texels), look);
    const Image plain = draw(sceneWith(factored({}), texels), look);
    EXPECT_EQ(given.values, plain.values) << shadingName(shading);
  }
}

// Filtered: bilinear texels, by the reference in double. The roughness is above 0.4, so the
// driver's fixed-point filter (3.3e-3 of the texel) causes less than 4 x 3.3e-3 / 0.4 of the
// exponent, 1/e of that in the lobe, and as much in its height.
TEST_P(ParameterTexture, AgreesWithTheReference) {
  const auto texels = png(4, 4, [](int x, int y) {
    return glm::ivec4(60 + 60 * x, 110 + 40 * y, 80 * ((x + y) % 4), 120 + 40 * x);
  });
  for (const Shading shading : programs) {
    const Look look = lookFor(shading);
    Material m = textured({1, 1, 0.8, 1, 0.6});
    for (std::optional<Texture>* t :
         {&m.parameterTextures.metallicRoughness, &m.parameterTextures.occlusion,
          &m.parameterTextures.specular, &m.parameterTextures.transmission})
      (*t)->sampler.magnify = (*t)->sampler.minify = Filter::linear;
    m.parameterTextures.specular->transform[2] = {0.25, 0.125};  // its own texture coordinates
    Scene scene = sceneWith(m, texels);
    const Image drawn = draw(scene, look);
    const DecodedImages images = decodeImages(scene, look);
    const Image truth = ReferenceRenderer(scene, images, boundsOf(scene), look).draw();
    double worst = 0;
    int off = 0;
    for (int y = 0; y < 48; ++y)
      for (int x = 0; x < 48; ++x) {
        const glm::dvec3 d = glm::abs(color(drawn, x, y) - color(truth, x, y));
        const double most = std::max({d.x, d.y, d.z});
        if (most > 0.05)
          ++off;  // a pixel at an outline
        else
          worst = std::max(worst, most);
      }
    EXPECT_LE(off, 4) << shadingName(shading);
    EXPECT_LE(worst, 0.03) << shadingName(shading);
  }
}

INSTANTIATE_TEST_SUITE_P(Software, ParameterTexture, softwareBackends(), nameOfBackend);

}  // namespace parameter_textures_gl_test
}  // namespace glint::test
