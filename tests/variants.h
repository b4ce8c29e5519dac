#pragma once

// A broad sample of the shader variants that scenes can need.

#include <set>

#include "glint/render/variant.h"
#include "glint/scene/look_text.h"
#include "scenes.h"

namespace glint {
inline void PrintTo(const Variant& v, std::ostream* out) {
  *out << shadingName(v.program) << (v.multisampled ? " multisampled" : "");
  for (const std::string& name : featureNames(v)) *out << " " << name;
}
}  // namespace glint

namespace glint::test {

struct VariantInputs {
  Mesh mesh;
  Material material;
  glm::dmat4 world{1};
  Look look;
  bool orthographic = false;

  Variant variant() const { return variantFor(mesh, material, world, look, orthographic); }
};

/// A lit triangle mesh under the default light in perspective, without special features.
inline VariantInputs plainInputs(Shading program = Shading::phong) {
  VariantInputs in;
  in.mesh = quad();
  in.mesh.texcoords = {std::vector<glm::vec2>(in.mesh.positions.size())};
  in.material = materialOf(1, 0.8, 0.5, 20);
  in.look.shading = program;
  in.look.antiAliasing = {AntiAliasing::Mode::none, 1};
  return in;
}

inline constexpr Shading everyShading[] = {Shading::flat, Shading::gouraud, Shading::phong,
                                           Shading::blinnPhong, Shading::environment};

inline Light lightOf(Light::Type type) {
  Light light = directional({1, 2, 3});
  light.type = type;
  light.position = {1, 2, 3};
  return light;
}

/// Single features and some pairs of them, under each program: some hundred variants.
inline std::set<Variant> sampledVariants() {
  using Change = void (*)(VariantInputs&);
  static constexpr Change changes[] = {
      [](VariantInputs&) {},
      [](VariantInputs& in) { in.material.unlit = true; },
      [](VariantInputs& in) { in.look.noLights = true; },
      [](VariantInputs& in) { in.material.shading.diffuse = 0; },
      [](VariantInputs& in) { in.material.shading.specular = 0; },
      [](VariantInputs& in) {
        in.look.light = {lightOf(Light::Type::directional), lightOf(Light::Type::directional),
                         lightOf(Light::Type::point), lightOf(Light::Type::spot)};
      },
      [](VariantInputs& in) { in.look.light = {lightOf(Light::Type::point)}; },
      [](VariantInputs& in) { in.look.light = {lightOf(Light::Type::spot)}; },
      [](VariantInputs& in) {
        in.look.light = std::vector<Light>(128, lightOf(Light::Type::spot));
      },
      [](VariantInputs& in) { in.look.highlight = Highlight::pow; },
      [](VariantInputs& in) { in.look.highlight = Highlight::integer; },
      [](VariantInputs& in) {
        in.look.highlight = {Highlight::lyon, 8};
      },
      [](VariantInputs& in) {
        in.look.highlight = {Highlight::lyonTuned, 16};
      },
      [](VariantInputs& in) {
        in.look.highlight = {Highlight::lyonCross, 4};
      },
      [](VariantInputs& in) {
        in.look.highlight = {Highlight::pade, 64};
      },
      [](VariantInputs& in) { in.look.highlight = Highlight::gaussian; },
      [](VariantInputs& in) { in.look.highlight = Highlight::none; },
      [](VariantInputs& in) {
        in.look.light = {lightOf(Light::Type::point), lightOf(Light::Type::point),
                         lightOf(Light::Type::spot), lightOf(Light::Type::directional),
                         lightOf(Light::Type::directional)};
        in.look.highlight = Highlight::pow;
        in.look.highlight.add({Highlight::lyon, 4}, 1);
        in.look.highlight.add(Highlight::none, 2);
        in.look.highlight.add({Highlight::pade, 2}, 4);
      },
      [](VariantInputs& in) { in.orthographic = true; },
      [](VariantInputs& in) {
        in.world = scaling({1, 1, 10});
      },
      [](VariantInputs& in) { in.mesh.normalsMayCancel = true; },
      [](VariantInputs& in) { in.look.twoSided = true; },
      [](VariantInputs& in) { in.mesh.colors.assign(4, glm::vec4(1)); },
      [](VariantInputs& in) { in.material.colorTexture = Texture{}; },
      [](VariantInputs& in) { in.material.emission = glm::dvec3(1); },
      [](VariantInputs& in) {
        in.material.emission = glm::dvec3(1);
        in.material.emissionTexture = Texture{};
      },
      [](VariantInputs& in) { in.material.alphaMode = AlphaMode::mask; },
      [](VariantInputs& in) {
        in.material.alphaMode = AlphaMode::blend;
        in.material.alpha = 0.5;
      },
      [](VariantInputs& in) {
        in.material.parameterTextures.metallicRoughness = Texture{};
        in.material.textured =
            textured::exponent | textured::metalness | textured::specular | textured::diffuse;
      },
      [](VariantInputs& in) {
        in.material.parameterTextures.occlusion = Texture{};
        in.material.parameterTextures.occlusion->texcoord = 0;
        in.material.parameterTextures.specular = Texture{};
        in.material.parameterTextures.specular->transform[2] = {0.5, 0.25};
        in.material.textured |= textured::ambient | textured::specular;
      },
      [](VariantInputs& in) {
        in.material.shading.transmission = 0.5;
        in.material.parameterTextures.transmission = Texture{};
        in.material.textured |= textured::transmission;
      },
      [](VariantInputs& in) { in.look.normalization = Normalization::exact; },
      [](VariantInputs& in) { in.look.specularAntialiasing = SpecularAntialiasing::kaplanyan; },
      [](VariantInputs& in) {
        in.look.specularAntialiasing = SpecularAntialiasing::toksvig;
        in.material.normalTexture = Texture{};
        in.mesh.tangents.assign(in.mesh.positions.size(), glm::vec4(1, 0, 0, 1));
      },
      [](VariantInputs& in) {
        in.look.highlight = {Highlight::table, 64};
      },
      [](VariantInputs& in) { in.look.antiAliasing = {}; },
      [](VariantInputs& in) { in.look.environment = Environment::sky; },
      [](VariantInputs& in) { in.look.environment = Environment::white; },
      [](VariantInputs& in) { in.look.fresnel = Fresnel::textbook; },
      [](VariantInputs& in) { in.look.fresnel = Fresnel::schlick; },
      [](VariantInputs& in) {
        in.look.fresnel = Fresnel::schlick;
        in.look.schlickExponent = 4;
      },
      [](VariantInputs& in) { in.look.fresnel = Fresnel::schlickExp2; },
      [](VariantInputs& in) { in.look.fresnel = Fresnel::rational; },
      [](VariantInputs& in) { in.material.shading.metalness = 1; },
      [](VariantInputs& in) { in.material.shading.metalness = 0.5; },
      [](VariantInputs& in) { in.material.shading.transmission = 0.5; },
      [](VariantInputs& in) { in.material.shading.ior = 0.5; },
  };
  constexpr std::size_t count = std::size(changes);
  std::set<Variant> variants;
  for (Shading program : everyShading)
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t step : {std::size_t(0), std::size_t(1), std::size_t(5), std::size_t(12)}) {
        VariantInputs in = plainInputs(program);
        changes[i](in);
        changes[(i + step) % count](in);
        variants.insert(in.variant());
      }
  // All features at once.
  for (Shading program : everyShading) {
    VariantInputs in = plainInputs(program);
    for (std::size_t i = 5; i < count; ++i) changes[i](in);
    variants.insert(in.variant());
  }
  return variants;
}

}  // namespace glint::test
