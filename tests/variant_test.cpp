// Shader variants: each feature is used for its reason, and for no other.

#include <gmock/gmock.h>

#include <algorithm>
#include <random>

#include "glint/render/draw_list.h"
#include "glint/render/variant.h"
#include "glint/scene/look_text.h"
#include "variants.h"

namespace glint {
void PrintTo(const Variant& v, std::ostream* out) {
  *out << shadingName(v.program) << (v.multisampled ? " multisampled" : "");
  for (const std::string& name : featureNames(v)) *out << " " << name;
}
}  // namespace glint

namespace glint::test::variant_test {

bool computesPixels(Shading s) {
  return s == Shading::phong || s == Shading::blinnPhong || s == Shading::environment;
}

// The variant for plainInputs: one directional light, diffuse and specular, V at each pixel.
Variant plainVariant(Shading program) {
  Variant v;
  v.program = program;
  v.directionalLights = 1;
  v.diffuse = v.specular = true;
  v.pixelPosition = computesPixels(program);
  v.dielectric = program == Shading::environment;
  return v;
}

struct Case {
  const char* name;
  void (*change)(VariantInputs&);
  void (*expect)(Variant&, Shading);
};

constexpr glint::Sampler ownSampler{glint::Filter::nearest, glint::Filter::linear,
                                    glint::MipFilter::none, glint::Wrap::clampToEdge,
                                    glint::Wrap::mirroredRepeat};

const Case cases[] = {
    {"nothing", [](VariantInputs&) {}, [](Variant&, Shading) {}},
    {"unlit material", [](VariantInputs& in) { in.material.unlit = true; },
     [](Variant& v, Shading) {
       v = Variant{};
       v.unlit = true;
     }},
    {"points without normals",
     [](VariantInputs& in) {
       in.mesh.topology = Topology::points;
       in.mesh.normals.clear();
     },
     [](Variant& v, Shading) {
       v = Variant{};
       v.unlit = true;
     }},
    {"lines with colours and emission",
     [](VariantInputs& in) {
       in.mesh.topology = Topology::lines;
       in.mesh.normals.clear();
       in.mesh.colors.resize(4);
       in.material.emission = glm::dvec3(1);
       in.material.doubleSided = true;
     },
     [](Variant& v, Shading) {
       v = Variant{};
       v.unlit = v.vertexColors = true;
     }},
    {"no lights", [](VariantInputs& in) { in.look.noLights = true; },
     [](Variant& v, Shading s) {
       v.directionalLights = 0;
       v.diffuse = v.specular = false;
       v.pixelPosition = s == Shading::environment;
     }},
    {"an empty list of lights", [](VariantInputs& in) { in.look.light.emplace(); },
     [](Variant& v, Shading s) {
       v.directionalLights = 0;
       v.diffuse = v.specular = false;
       v.pixelPosition = s == Shading::environment;
     }},
    {"no lights on an uneven two-sided mesh",
     [](VariantInputs& in) {
       in.look.noLights = in.material.doubleSided = in.mesh.normalsMayCancel = true;
       in.world = glint::test::scaling({1, 2, 3});
     },
     [](Variant& v, Shading s) {
       v.directionalLights = 0;
       v.diffuse = v.specular = false;
       const bool sees = s == Shading::environment;
       v.pixelPosition = v.vanishingNormal = v.twoSided = v.unevenScale = sees;
       v.denserSide = sees;
     }},
    {"black light",
     [](VariantInputs& in) {
       in.look.light = {glint::test::directional({0, 0, 1}, glm::dvec3(0))};
     },
     [](Variant& v, Shading s) {
       v.directionalLights = 0;
       v.diffuse = v.specular = false;
       v.pixelPosition = s == Shading::environment;
     }},
    {"lights of every kind",
     [](VariantInputs& in) {
       in.look.light = {lightOf(Light::Type::spot), lightOf(Light::Type::directional),
                        lightOf(Light::Type::point), lightOf(Light::Type::camera),
                        lightOf(Light::Type::point)};
     },
     [](Variant& v, Shading) {
       v.directionalLights = v.pointLights = 2;
       v.spotLights = 1;
     }},
    {"diffuse alone", [](VariantInputs& in) { in.material.shading.specular = 0; },
     [](Variant& v, Shading s) {
       v.specular = false;
       v.pixelPosition = s == Shading::environment;
     }},
    {"diffuse alone under a point light",
     [](VariantInputs& in) {
       in.material.shading.specular = 0;
       in.look.light = {lightOf(Light::Type::point)};
     },
     [](Variant& v, Shading s) {
       v.specular = false;
       v.directionalLights = 0;
       v.pointLights = 1;
       v.pixelPosition = computesPixels(s);
     }},
    {"specular alone", [](VariantInputs& in) { in.material.shading.diffuse = 0; },
     [](Variant& v, Shading) { v.diffuse = false; }},
    {"neither",
     [](VariantInputs& in) { in.material.shading.diffuse = in.material.shading.specular = 0; },
     [](Variant& v, Shading s) {
       v.directionalLights = 0;
       v.diffuse = v.specular = false;
       v.pixelPosition = s == Shading::environment;
     }},
    {"pow", [](VariantInputs& in) { in.look.highlight = glint::Highlight::pow; },
     [](Variant& v, Shading) { v.highlight = glint::Highlight::pow; }},
    {"pow without a highlight",
     [](VariantInputs& in) {
       in.look.highlight = glint::Highlight::pow;
       in.material.shading.specular = 0;
     },
     [](Variant& v, Shading s) {
       v.specular = false;
       v.pixelPosition = s == Shading::environment;
     }},
    {"lyon",
     [](VariantInputs& in) {
       in.look.highlight = {glint::Highlight::lyon, 8};
     },
     [](Variant& v, Shading) {
       v.highlight = {glint::Highlight::lyon, 8};
     }},
    {"none", [](VariantInputs& in) { in.look.highlight = glint::Highlight::none; },
     [](Variant& v, Shading s) {
       v.specular = false;
       v.pixelPosition = s == Shading::environment;
     }},
    {"forms by light: the brightest, whatever its type, first",
     [](VariantInputs& in) {
       in.look.light = {lightOf(Light::Type::spot), lightOf(Light::Type::directional),
                        lightOf(Light::Type::point), lightOf(Light::Type::directional)};
       for (int i : {0, 1, 2, 3})  // spot 1, directional 4, point 3, directional 2
         (*in.look.light)[std::size_t(i)].intensity *= i == 0 ? 1.0 : 5.0 - i;
       in.look.highlight = glint::Highlight::pow;
       in.look.highlight.add({glint::Highlight::lyon, 8}, 2);
       in.look.highlight.add(glint::Highlight::none, 3);
     },
     [](Variant& v, Shading) {
       v.directionalLights = 2;
       v.pointLights = v.spotLights = 1;
       v.highlight = glint::Highlight::pow;
       v.dimmer = {{{glint::Highlight::lyon, 8}, 1, 1, 0}, {glint::Highlight::none, 2, 1, 0}};
     }},
    {"forms for lights that are not there",
     [](VariantInputs& in) {
       in.look.highlight = glint::Highlight::pow;
       in.look.highlight.add({glint::Highlight::lyon, 8}, 1);
     },
     [](Variant& v, Shading) { v.highlight = glint::Highlight::pow; }},
    {"gaussian for this material",
     [](VariantInputs& in) {
       in.look.highlight = glint::Highlight::pow;
       in.material.highlight = glint::Highlight::gaussian;
     },
     [](Variant& v, Shading) { v.highlight = glint::Highlight::gaussian; }},
    {"a form without exponent",
     [](VariantInputs& in) {
       in.look.highlight = {glint::Highlight::pade, 4};
       in.material.shading.exponent = 0;
     },
     [](Variant&, Shading) {}},
    {"integer",
     [](VariantInputs& in) {
       in.look.highlight = glint::Highlight::integer;
       in.material.shading.exponent = 21;
     },
     [](Variant& v, Shading s) {
       const bool blinn = s == Shading::blinnPhong || s == Shading::environment;
       v.highlight = {glint::Highlight::integer, blinn ? 84 : 21};
     }},
    {"integer with another exponent",
     [](VariantInputs& in) {
       in.look.highlight = glint::Highlight::integer;
       in.material.shading.exponent = 20.1;
     },
     [](Variant&, Shading) {}},
    {"infinite viewer", [](VariantInputs& in) { in.look.viewer = glint::Viewer::infinite; },
     [](Variant& v, Shading) {
       v.constantView = true;
       v.pixelPosition = false;
     }},
    {"orthographic", [](VariantInputs& in) { in.orthographic = true; },
     [](Variant& v, Shading) {
       v.constantView = true;
       v.pixelPosition = false;
     }},
    {"orthographic with a point light",
     [](VariantInputs& in) {
       in.orthographic = true;
       in.look.light = {lightOf(Light::Type::point)};
     },
     [](Variant& v, Shading s) {
       v.constantView = true;
       v.directionalLights = 0;
       v.pointLights = 1;
       v.pixelPosition = computesPixels(s);
     }},
    {"uneven scale",
     [](VariantInputs& in) {
       in.world = glint::test::scaling({1, 1, 1.001});
     },
     [](Variant& v, Shading) { v.unevenScale = true; }},
    {"shear", [](VariantInputs& in) { in.world[1][0] = 0.1; },
     [](Variant& v, Shading) { v.unevenScale = true; }},
    {"singular",
     [](VariantInputs& in) {
       in.world = glint::test::scaling({1, 1, 0});
     },
     [](Variant& v, Shading) { v.unevenScale = true; }},
    {"rotation, mirror, translation and one tiny scale",
     [](VariantInputs& in) {
       in.world = glint::test::translation({1, 2, 3}) * glint::test::rotation(1) *
                  glint::test::scaling({-1e-20, 1e-20, 1e-20});
     },
     [](Variant&, Shading) {}},
    {"one huge scale",
     [](VariantInputs& in) {
       in.world = glint::test::rotation(2) * glint::test::scaling(glm::dvec3(1e20));
     },
     [](Variant&, Shading) {}},
    {"vanishing normals", [](VariantInputs& in) { in.mesh.normalsMayCancel = true; },
     [](Variant& v, Shading s) { v.vanishingNormal = computesPixels(s); }},
    {"vanishing normals seen in parallel",
     [](VariantInputs& in) { in.mesh.normalsMayCancel = in.orthographic = true; },
     [](Variant& v, Shading s) {
       v.constantView = true;
       v.vanishingNormal = v.pixelPosition = computesPixels(s);
     }},
    {"double sided", [](VariantInputs& in) { in.material.doubleSided = true; },
     [](Variant& v, Shading s) {
       v.twoSided = true;
       v.denserSide = s == Shading::environment;
     }},
    {"--two-sided", [](VariantInputs& in) { in.look.twoSided = true; },
     [](Variant& v, Shading s) {
       v.twoSided = true;
       v.denserSide = s == Shading::environment;
     }},
    {"a normalised highlight",
     [](VariantInputs& in) { in.look.normalization = glint::Normalization::exact; },
     [](Variant&, Shading) {}},
    {"a normalised highlight of an exponent from a texture",
     [](VariantInputs& in) {
       in.look.normalization = glint::Normalization::simple;
       in.material.parameterTextures.metallicRoughness.emplace();
       in.material.textured = glint::textured::exponent;
     },
     [](Variant& v, Shading) {
       v.normalized = true;
       v.normalization = glint::Normalization::simple;
       v.textured = glint::textured::exponent;
       v.metallicRoughnessTexture = true;
       v.parameterPlaceCount = 1;
     }},
    {"--specular-antialiasing",
     [](VariantInputs& in) { in.look.specularAntialiasing = SpecularAntialiasing::kaplanyan; },
     [](Variant& v, Shading s) { v.specularAntialiasing = computesPixels(s); }},
    {"--specular-antialiasing without a highlight",
     [](VariantInputs& in) {
       in.look.specularAntialiasing = SpecularAntialiasing::kaplanyan;
       in.material.shading.specular = 0;
     },
     [](Variant& v, Shading s) {
       v.specular = false;
       v.pixelPosition = s == Shading::environment;
     }},
    {"an integer power that is filtered",
     [](VariantInputs& in) {
       in.look.specularAntialiasing = SpecularAntialiasing::kaplanyan;
       in.look.highlight = glint::Highlight::integer;
     },
     [](Variant& v, Shading s) {
       v.specularAntialiasing = computesPixels(s);
       if (!computesPixels(s)) v.highlight = {glint::Highlight::integer, 20};
     }},
    {"vertex colours", [](VariantInputs& in) { in.mesh.colors.resize(4); },
     [](Variant& v, Shading) { v.vertexColors = true; }},
    {"colour texture", [](VariantInputs& in) { in.material.colorTexture.emplace(); },
     [](Variant& v, Shading) { v.colorTexture = true; }},
    {"colour texture with a sampler of its own",
     [](VariantInputs& in) {
       in.material.colorTexture = glint::Texture{0, 0, ownSampler};
     },
     [](Variant& v, Shading) {
       v.colorTexture = true;
       v.samplers[0] = ownSampler;
     }},
    {"emission texture with a sampler of its own, without emission",
     [](VariantInputs& in) {
       in.material.emissionTexture = glint::Texture{0, 0, ownSampler};
     },
     [](Variant&, Shading) {}},
    {"colour texture without coordinates",
     [](VariantInputs& in) {
       in.material.colorTexture.emplace();
       in.mesh.texcoords.clear();
     },
     [](Variant&, Shading) {}},
    {"emission",
     [](VariantInputs& in) {
       in.material.emission = {0, 0, 1e-9};
     },
     [](Variant& v, Shading) { v.emission = true; }},
    {"emission texture",
     [](VariantInputs& in) {
       in.material.emission = glm::dvec3(1);
       in.material.emissionTexture.emplace();
     },
     [](Variant& v, Shading) { v.emission = v.emissionTexture = true; }},
    {"emission texture without emission",
     [](VariantInputs& in) { in.material.emissionTexture.emplace(); }, [](Variant&, Shading) {}},
    {"mask", [](VariantInputs& in) { in.material.alphaMode = AlphaMode::mask; },
     [](Variant& v, Shading) { v.alphaMask = true; }},
    {"blend",
     [](VariantInputs& in) {
       in.material.alphaMode = AlphaMode::blend;
       in.material.alpha = 0.5;
     },
     [](Variant& v, Shading) { v.alphaBlend = true; }},
    {"blend with an alpha of 1",
     [](VariantInputs& in) { in.material.alphaMode = AlphaMode::blend; }, [](Variant&, Shading) {}},
    {"blend with vertex colours that let something through",
     [](VariantInputs& in) {
       in.material.alphaMode = AlphaMode::blend;
       in.mesh.colors.assign(4, glm::vec4(1));
       in.mesh.colors[2].a = 0.5f;
     },
     [](Variant& v, Shading) { v.alphaBlend = v.vertexColors = true; }},
    {"blend with a texture of which nothing is known",
     [](VariantInputs& in) {
       in.material.alphaMode = AlphaMode::blend;
       in.material.colorTexture.emplace();
     },
     [](Variant& v, Shading) { v.alphaBlend = v.colorTexture = true; }},
    {"blend with texels that are opaque where they show",
     [](VariantInputs& in) {
       in.material.alphaMode = AlphaMode::blend;
       in.material.colorTexture.emplace();
       in.mesh.opaqueTexels = true;
     },
     [](Variant& v, Shading) { v.colorTexture = true; }},
    {"metallic-roughness texture",
     [](VariantInputs& in) {
       in.material.parameterTextures.metallicRoughness.emplace();
       in.material.textured = glint::textured::exponent | glint::textured::metalness;
     },
     [](Variant& v, Shading) {
       v.textured = glint::textured::exponent | glint::textured::metalness;
       v.metallicRoughnessTexture = true;
       v.parameterPlaceCount = 1;
     }},
    {"metallic-roughness texture whose place numbers have taken",
     [](VariantInputs& in) { in.material.parameterTextures.metallicRoughness.emplace(); },
     [](Variant&, Shading) {}},
    {"metallic-roughness texture beside a colour texture at the same place",
     [](VariantInputs& in) {
       in.material.parameterTextures.metallicRoughness.emplace();
       in.material.colorTexture.emplace();
       in.material.textured = glint::textured::exponent;
     },
     [](Variant& v, Shading s) {
       const bool pixels = s != Shading::flat && s != Shading::gouraud;
       v.textured = glint::textured::exponent;
       v.metallicRoughnessTexture = v.colorTexture = true;
       v.parameterPlaces[0] = pixels ? -1 : 0;
       v.parameterPlaceCount = pixels ? 0 : 1;
     }},
    {"occlusion texture with a sampler of its own",
     [](VariantInputs& in) {
       in.material.parameterTextures.occlusion = glint::Texture{0, 0, ownSampler};
       in.material.textured = glint::textured::ambient;
     },
     [](Variant& v, Shading) {
       v.textured = glint::textured::ambient;
       v.occlusionTexture = true;
       v.parameterPlaceCount = 1;
       v.samplers[4] = ownSampler;
     }},
    {"occlusion texture",
     [](VariantInputs& in) {
       in.material.parameterTextures.occlusion.emplace();
       in.material.textured = glint::textured::ambient;
     },
     [](Variant& v, Shading) {
       v.textured = glint::textured::ambient;
       v.occlusionTexture = true;
       v.parameterPlaceCount = 1;
     }},
    {"occlusion texture without ambient light",
     [](VariantInputs& in) {
       in.material.parameterTextures.occlusion.emplace();
       in.material.textured = glint::textured::ambient;
       in.look.ambientLight = glm::dvec3(0);
     },
     [](Variant&, Shading) {}},
    {"transmission texture",
     [](VariantInputs& in) {
       in.material.shading.transmission = 0.5;
       in.material.parameterTextures.transmission.emplace();
       in.material.textured = glint::textured::transmission;
     },
     [](Variant& v, Shading s) {
       if (s != Shading::environment) return;
       v.textured = glint::textured::transmission;
       v.refraction = v.transmissionTexture = true;
       v.parameterPlaceCount = 1;
     }},
    {"msaa:4",
     [](VariantInputs& in) {
       in.look.antiAliasing = {AntiAliasing::Mode::msaa, 4};
     },
     [](Variant& v, Shading) { v.multisampled = true; }},
    {"msaa:1",
     [](VariantInputs& in) {
       in.look.antiAliasing = {AntiAliasing::Mode::msaa, 1};
     },
     [](Variant&, Shading) {}},
    {"ssaa:4",
     [](VariantInputs& in) {
       in.look.antiAliasing = {AntiAliasing::Mode::ssaa, 4};
     },
     [](Variant&, Shading) {}},
    {"sky", [](VariantInputs& in) { in.look.environment = glint::Environment::sky; },
     [](Variant& v, Shading s) {
       if (s == Shading::environment) v.environment = glint::Environment::sky;
     }},
    {"schlick", [](VariantInputs& in) { in.look.fresnel = glint::Fresnel::schlick; },
     [](Variant& v, Shading s) {
       if (s == Shading::environment) {
         v.fresnel = glint::Fresnel::schlick;
         v.schlickFifth = true;
       }
     }},
    {"schlick with another exponent",
     [](VariantInputs& in) {
       in.look.fresnel = glint::Fresnel::schlick;
       in.look.schlickExponent = 4;
     },
     [](Variant& v, Shading s) {
       if (s == Shading::environment) v.fresnel = glint::Fresnel::schlick;
     }},
    {"rational, for this material",
     [](VariantInputs& in) {
       in.look.fresnel = glint::Fresnel::schlick;
       in.material.fresnel = glint::Fresnel::rational;
     },
     [](Variant& v, Shading s) {
       if (s == Shading::environment) v.fresnel = glint::Fresnel::rational;
     }},
    {"metal",
     [](VariantInputs& in) {
       in.look.fresnel = glint::Fresnel::schlick;  // metals have no index, so this has no effect
       in.material.shading.metalness = 1;
     },
     [](Variant& v, Shading s) {
       v.dielectric = false;
       v.metal = s == Shading::environment;
     }},
    {"half a metal", [](VariantInputs& in) { in.material.shading.metalness = 0.5; },
     [](Variant& v, Shading s) { v.metal = s == Shading::environment; }},
    {"thinner than the medium", [](VariantInputs& in) { in.look.mediumIor = 1.6; },
     [](Variant& v, Shading s) { v.denserSide = s == Shading::environment; }},
    {"as thin as the medium, both sides",
     [](VariantInputs& in) {
       in.look.mediumIor = in.material.shading.ior;
       in.look.twoSided = true;
     },
     [](Variant& v, Shading) { v.twoSided = true; }},
    {"transmission", [](VariantInputs& in) { in.material.shading.transmission = 0.1; },
     [](Variant& v, Shading s) { v.refraction = s == Shading::environment; }},
};

TEST(Variants, SwitchEachFeatureForItsReasonAlone) {
  for (const Case& c : cases)
    for (Shading program : everyShading) {
      VariantInputs in = plainInputs(program);
      c.change(in);
      Variant expected = plainVariant(program);
      c.expect(expected, program);
      if (expected.unlit) expected.program = in.variant().program;  // any program
      EXPECT_EQ(in.variant(), expected) << c.name << " under " << glint::shadingName(program);
    }
}

TEST(Variants, OfUnlitThingsAreTheSameUnderEveryProgram) {
  for (Shading program : everyShading) {
    VariantInputs in = plainInputs(program);
    in.material.unlit = true;
    VariantInputs other = plainInputs(Shading::phong);
    other.material.unlit = true;
    EXPECT_EQ(in.variant(), other.variant());
  }
}

// Numbers, colours, the camera and the resolution are uniforms and do not change the variant.
TEST(Variants, DoNotDependOnNumbers) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(0.01, 0.99);
  for (Shading program : everyShading) {
    const Variant plain = plainInputs(program).variant();
    for (int i = 0; i < 50; ++i) {
      VariantInputs in = plainInputs(program);
      in.material.shading.ambient = number(random);
      in.material.shading.diffuse = number(random);
      in.material.shading.specular = number(random);
      in.material.shading.exponent = 1000 * number(random);
      in.material.shading.ior = 1 + number(random);
      in.material.shading.color = {number(random), 0, number(random)};
      in.material.alpha = number(random);
      in.material.alphaCutoff = number(random);
      in.world = glint::test::translation({number(random), 1e6, 0}) *
                 glint::test::rotation(6 * number(random)) *
                 glint::test::scaling(glm::dvec3(number(random)));
      in.look.ambientLight = glm::dvec3(number(random));
      in.look.blinnFactor = in.look.schlickExponent = number(random);
      in.look.mediumIor = 0.9 * number(random);
      in.look.environmentRotation = in.look.exposure = number(random);
      in.look.cameraPosition = glm::dvec3(number(random));
      in.look.resolution = {i + 1, 7};
      in.look.backgroundColor = glm::dvec3(number(random));
      in.look.noBackground = i % 2;
      in.look.environmentBackground = i % 3 == 0;
      EXPECT_EQ(in.variant(), plain);
    }
  }
}

TEST(Variants, ReasonsAndNamesTellTheSame) {
  for (const Case& c : cases)
    for (Shading program : everyShading) {
      VariantInputs in = plainInputs(program);
      c.change(in);
      const Variant v = in.variant();
      const std::vector<std::string> names = glint::featureNames(v);
      for (const auto& reason :
           glint::reasonsFor(v, in.mesh, in.material, in.look, in.orthographic)) {
        EXPECT_FALSE(reason.reason.empty());
        const bool named = std::any_of(names.begin(), names.end(), [&](const std::string& name) {
          return name == reason.feature || name.starts_with(reason.feature + ":");
        });
        EXPECT_EQ(named, reason.present)
            << c.name << ": " << reason.feature << " under " << glint::shadingName(program);
      }
    }
}

TEST(Variants, SampleIsBroad) {
  const auto sample = glint::test::sampledVariants();
  EXPECT_GT(sample.size(), 150u);
  for (Shading program : everyShading)
    EXPECT_GT(std::count_if(sample.begin(), sample.end(),
                            [&](const Variant& v) { return v.program == program; }),
              20);
}

TEST(Similarity, IsRotationAndOneScaleToAMillionth) {
  const glm::dmat3 turned(glint::test::rotation(0.7));
  for (double scale : {1e-300, 1e-20, 1.0, 1e20, 1e300}) {
    EXPECT_TRUE(glint::isSimilarity(turned * scale)) << scale;
    EXPECT_TRUE(glint::isSimilarity(-turned * scale)) << scale;
    // A relative scale error e changes the Gram matrix by 2e: the limit is e = 5e-7.
    EXPECT_TRUE(
        glint::isSimilarity(glm::dmat3(glint::test::scaling({scale, scale, scale * (1 + 4e-7)}))));
    EXPECT_FALSE(
        glint::isSimilarity(glm::dmat3(glint::test::scaling({scale, scale, scale * (1 + 6e-7)}))));
  }
  EXPECT_FALSE(glint::isSimilarity(glm::dmat3(0.0)));
  EXPECT_FALSE(glint::isSimilarity(glm::dmat3(glint::test::scaling({0, 1, 1}))));
}

TEST(ImagesRead, AreThoseOfTheVariants) {
  glint::Material material = glint::test::materialOf(1, 1, 0, 1);
  material.colorTexture = glint::Texture{1, 0, {}};
  material.emissionTexture = glint::Texture{3, 0, {}};
  glint::Scene scene = glint::test::sceneOf(plainInputs().mesh, material);
  scene.images.resize(5);
  EXPECT_THAT(glint::imagesRead(scene, {}), testing::ElementsAre(1));  // no emission factor
  scene.materials[0].emission = glm::dvec3(1);
  EXPECT_THAT(glint::imagesRead(scene, {}), testing::ElementsAre(1, 3));
  scene.materials[0].unlit = true;
  EXPECT_THAT(glint::imagesRead(scene, {}), testing::ElementsAre(1));
  scene.instances.clear();
  EXPECT_TRUE(glint::imagesRead(scene, {}).empty());
}

TEST(Lights, AreTheGivenOnesElseTheDefaultUnlessThereAreNone) {
  glint::Look look;
  ASSERT_EQ(glint::lightsOf(look).size(), 1u);
  EXPECT_EQ(glint::lightsOf(look)[0].type, Light::Type::camera);
  EXPECT_EQ(glint::lightsOf(look)[0].direction, glm::dvec3(-0.5, 0.7, 1));
  EXPECT_EQ(glint::lightsOf(look)[0].intensity, glm::dvec3(1));
  look.light = {glint::test::directional({1, 0, 0}), lightOf(Light::Type::point)};
  EXPECT_EQ(glint::lightsOf(look), *look.light);
  look.noLights = true;
  EXPECT_TRUE(glint::lightsOf(look).empty());
}

}  // namespace glint::test::variant_test
