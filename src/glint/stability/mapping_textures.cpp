#include "glint/stability/mapping_textures.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "glint/gl/framebuffer.h"
#include "glint/image/mipmaps.h"
#include "glint/image/srgb.h"
#include "glint/scene/look_text.h"
#include "glint/shading/safe.h"
#include "glint/stability/scenes.h"

namespace glint::stability {
namespace {

/// 2 x 2 texels: rows from the top, as in a file.
ByteImage texels(const std::vector<glm::ivec4>& rgba, int width = 2) {
  ByteImage image;
  image.width = width;
  image.height = int(rgba.size()) / width;
  for (const glm::ivec4& t : rgba)
    for (int c = 0; c < 4; ++c) image.values.push_back(std::uint8_t(t[c]));
  return image;
}

/// A square of half size 1 whose corners are the texture's; v points down, as in glTF.
struct Textured {
  Scene scene;
  DecodedImages images;
  Material& material() { return scene.materials[0]; }
};

Textured textured(Material material, ByteImage image, bool isData) {
  Textured t;
  Mesh mesh = square({0, 0, 1}, 1);
  mesh.texcoords = {{{0, 1}, {1, 1}, {1, 0}, {0, 0}}};
  mesh.tangents.assign(4, glm::vec4(1, 0, 0, 1));
  t.scene = sceneOf(mesh, std::move(material));
  t.scene.images.push_back({"texels", {}, isData});
  t.images[0].image = std::move(image);
  return t;
}

Texture nearest() {
  Texture texture;
  texture.sampler = {Filter::nearest, Filter::nearest, MipFilter::none, Wrap::clampToEdge,
                     Wrap::clampToEdge};
  return texture;
}

/// A normal map's texel as a direction.
glm::dvec3 mapped(const glm::ivec4& code) { return 2.0 * glm::dvec3(code) / 255.0 - 1.0; }

void expectNormal(Bench& bench, Record& record, const std::string& what, float handedness,
                  double scale, const glm::ivec4& code) {
  const glm::dvec3 m = mapped(code) * glm::dvec3(scale, scale * double(handedness), 1);
  const glm::dvec3 n = safeNormalize(m);
  for (const Shading shading : {Shading::phong, Shading::blinnPhong, Shading::environment})
    for (const glm::dvec3& l : {glm::dvec3(1, 0, 1), {0, 1, 1}, {0, 0, 1}}) {
      Textured t = textured(litMaterial(1, 0, 1), texels({code, code, code, code}), true);
      t.material().normalTexture = nearest();
      t.material().normalScale = scale;
      for (glm::vec4& tangent : t.scene.meshes[0].tangents) tangent.w = handedness;
      Look look = parallel(bench.lit(shading, l), {0, 0, 1}, 3);
      const double lit = std::max(glm::dot(n, safeNormalize(l)), 0.0);
      record.near(what + ", lit from " + vectorText(l),
                  middle(bench.draw(t.scene, look, t.images)).r, lit, 2e-6);
      record.near("the reference's", middle(bench.reference(t.scene, look, t.images)).r, lit, 1e-6);
    }
}

const std::vector<glm::ivec4> corners{
    {255, 0, 0, 255}, {0, 255, 0, 255}, {0, 0, 255, 255}, {128, 128, 0, 255}};

}  // namespace

void m6(Bench& bench, Record& record) {
  expectNormal(bench, record, "red 200: right", 1, 1, {200, 128, 220, 255});
  expectNormal(bench, record, "green 200: up", 1, 1, {128, 200, 220, 255});
}

void m7(Bench& bench, Record& record) {
  expectNormal(bench, record, "handedness -1: green down", -1, 1, {150, 200, 220, 255});
}

void m8(Bench& bench, Record& record) {
  expectNormal(bench, record, "scale 0.25", 1, 0.25, {220, 60, 200, 255});
  expectNormal(bench, record, "scale 2", 1, 2, {160, 110, 230, 255});
}

void m9(Bench& bench, Record& record) {
  for (const Shading shading : everyShading)
    for (const bool unlit : {false, true}) {
      Material m = unlit ? unlitMaterial(glm::dvec3(1)) : litMaterial(1, 0, 1);
      m.shading.color = glm::dvec3(1);
      Textured t = textured(m, texels(corners), false);
      t.material().colorTexture = nearest();
      Look look = parallel(bench.lit(shading), {0, 0, 1}, 4);
      const Image image = bench.draw(t.scene, look, t.images);
      const char* const names[] = {"top left", "top right", "bottom left", "bottom right"};
      for (int i = 0; i < 4; ++i)
        record.color(std::string(shadingName(shading)) + (unlit ? ", unlit, " : ", ") + names[i],
                     at(image, i % 2 ? 3 : 0, i / 2 ? 3 : 0),
                     {decodeSrgb8(std::uint8_t(corners[std::size_t(i)].r)),
                      decodeSrgb8(std::uint8_t(corners[std::size_t(i)].g)),
                      decodeSrgb8(std::uint8_t(corners[std::size_t(i)].b))},
                     1e-6);
    }
}

void m10(Bench& bench, Record& record) {
  for (const Shading shading : everyShading) {
    Material m = litMaterial(0, 0, 1);
    m.emission = {0.5, 2, 3};
    Textured t = textured(m, texels(corners), false);
    t.material().emissionTexture = nearest();
    const Look look = parallel(bench.look(shading), {0, 0, 1}, 4);
    const Image image = bench.draw(t.scene, look, t.images);
    record.color(std::string(shadingName(shading)) + ", top left", at(image, 0, 0), {0.5, 0, 0},
                 1e-6);
    record.color(std::string(shadingName(shading)) + ", bottom left", at(image, 0, 3), {0, 0, 3},
                 3e-6);
  }
}

void m11(Bench& bench, Record& record) {
  for (const Shading shading : {Shading::gouraud, Shading::phong, Shading::blinnPhong})
    for (const double alpha : {1.0, 0.5}) {
      Material m = unlitMaterial(glm::dvec3(1));
      m.alphaMode = AlphaMode::blend;
      m.alpha = alpha;
      Textured t = textured(m,
                            texels({{255, 255, 255, 255},
                                    {255, 255, 255, 51},
                                    {255, 255, 255, 0},
                                    {255, 255, 255, 204}}),
                            false);
      t.material().colorTexture = nearest();
      Look look = parallel(bench.look(shading), {0, 0, 1}, 4);
      look.backgroundColor = {0.25, 0.5, 0};
      const Image image = bench.draw(t.scene, look, t.images);
      const double covers[] = {1, 0.2, 0, 0.8};
      for (int i = 0; i < 4; ++i) {
        const double a = alpha * covers[i];
        record.color("alpha " + numberText(a), at(image, i % 2 ? 3 : 0, i / 2 ? 3 : 0),
                     a + (1 - a) * look.backgroundColor, 1e-6);
      }
    }
}

void m13(Bench& bench, Record& record) {
  // Each level has one colour, so that the drawn colour shows the level of detail. The picture's
  // height shows 64 texels.
  ByteImage base = texels(std::vector<glm::ivec4>(64 * 64, glm::ivec4(0, 0, 0, 255)), 64);
  std::vector<ByteImage> smaller;
  const int codes[] = {51, 102, 153, 204, 230, 255};
  for (int i = 0, size = 32; i < 6; ++i, size /= 2)
    smaller.push_back(texels(
        std::vector<glm::ivec4>(std::size_t(size * size), glm::ivec4(glm::ivec3(codes[i]), 255)),
        size));
  {
    for (const int pixels : {64, 32, 45, 16, 9}) {
      Material m = unlitMaterial(glm::dvec3(1));
      Textured t = textured(m, base, false);
      t.images[0].mipLevels = smaller;
      t.material().colorTexture = Texture{};
      t.material().colorTexture->sampler = {Filter::linear, Filter::linear, MipFilter::linear,
                                            Wrap::repeat, Wrap::repeat};
      const Look look = parallel(bench.look(Shading::phong), {0, 0, 1}, pixels);
      const double level = std::clamp(std::log2(64.0 / pixels), 0.0, 6.0);
      const int fine = std::min(int(level), 5);
      const auto value = [&](int i) {
        return i == 0 ? 0.0 : double(decodeSrgb8(std::uint8_t(codes[i - 1])));
      };
      const double expected = value(fine) + (level - fine) * (value(fine + 1) - value(fine));
      // The step of the coordinates is a difference of floats: 2 * 6e-8 over 1 / pixels, over ln 2.
      record.near("64 texels over " + std::to_string(pixels) + " pixels",
                  middle(bench.draw(t.scene, look, t.images)).r, expected, 5e-5);
      record.near("the reference's", middle(bench.reference(t.scene, look, t.images)).r, expected,
                  1e-6);
    }
  }
}

void m14(Bench& bench, Record& record) {
  // Between two texels in x, and outside the texture by each rule of wrapping.
  const ByteImage two = texels({{0, 0, 0, 255}, {255, 255, 255, 255}}, 2);
  for (const Wrap wrap : {Wrap::repeat, Wrap::mirroredRepeat, Wrap::clampToEdge}) {
    Textured t = textured(unlitMaterial(glm::dvec3(1)), two, false);
    t.material().colorTexture = Texture{};
    t.material().colorTexture->sampler = {Filter::linear, Filter::linear, MipFilter::none, wrap,
                                          wrap};
    for (auto& place : t.scene.meshes[0].texcoords[0]) place.x = 2 * place.x;
    const Image image =
        bench.draw(t.scene, parallel(bench.look(Shading::phong), {0, 0, 1}, 8), t.images);
    record.near("the mean of black and white is 1/2 in linear light, pixel 1 of texel 0.25 to 0.75",
                at(image, 1, 3).r, 0.25, 1e-6);
    record.near("at 1.125, by the rule of wrapping", at(image, 4, 3).r,
                wrap == Wrap::repeat ? 0.25 : 1, 1e-6);
    record.near("at 1.375", at(image, 5, 3).r,
                wrap == Wrap::repeat        ? 0.25
                : wrap == Wrap::clampToEdge ? 1
                                            : 0.75,
                1e-6);
  }
  for (int code = 0; code < 256; code += 15) {
    Textured t =
        textured(unlitMaterial(glm::dvec3(1)),
                 texels(std::vector<glm::ivec4>(4, glm::ivec4(glm::ivec3(code), 255))), false);
    t.material().colorTexture = nearest();
    const double s = code / 255.0;
    record.near("code " + std::to_string(code) + " of sRGB",
                middle(bench.draw(t.scene, parallel(bench.look(Shading::phong)), t.images)).r,
                s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4), 1e-7);
  }
}

// Thin triangles whose colours go from 0.4 to 0.6: the part of a pixel that they cover has no
// others.
void m15(Bench& bench, Record& record) {
  const int most = maxSamples();
  record.within("samples of the driver", most, 1, 1024);
  if (most < 2) return;
  Mesh mesh = thinTriangles(0.03f);
  const glm::vec4 colors[] = {{0.4f, 0.6f, 0.5f, 1}, {0.6f, 0.4f, 0.6f, 1}, {0.4f, 0.5f, 0.4f, 1}};
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) mesh.colors.push_back(colors[i % 3]);
  Look look = parallel(bench.look(Shading::phong), {0, 0, 1}, 16);
  look.antiAliasing = {AntiAliasing::Mode::msaa, std::min(most, 4)};
  look.noBackground = true;
  const Image image = bench.draw(sceneOf(mesh, unlitMaterial(glm::dvec3(1))), look);
  double low = 1, high = 0;
  for (std::size_t i = 0; i < image.values.size(); i += 4) {
    const double alpha = image.values[i + 3];
    for (std::size_t c = i; alpha > 0 && c < i + 3; ++c) {
      low = std::min(low, image.values[c] / alpha);
      high = std::max(high, image.values[c] / alpha);
    }
  }
  record.within("lowest", low, 0.4 - 1e-6, 0.6);
  record.within("highest", high, 0.4, 0.6 + 1e-6);
}

}  // namespace glint::stability
