// Shader variants: each feature is used for its reason, and for no other.

#include <gmock/gmock.h>

#include <algorithm>

#include "variants.h"

namespace glint::test::variant_test {

bool computesPixels(Shading s) { return s != Shading::flat && s != Shading::gouraud; }

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

void unchanged(Variant&, Shading) {}

void unlit(Variant& v, Shading) {
  v = Variant{};  // the same under every program
  v.unlit = true;
}

void withoutHighlight(Variant& v, Shading s) {
  v.specular = false;
  v.pixelPosition = s == Shading::environment;
}

/// No light is left to compute.
void dark(Variant& v, Shading s) {
  withoutHighlight(v, s);
  v.directionalLights = 0;
  v.diffuse = false;
}

void uneven(Variant& v, Shading) { v.unevenScale = true; }

void parallel(Variant& v, Shading) {
  v.constantView = true;
  v.pixelPosition = false;
}

void twoSided(Variant& v, Shading s) {
  v.twoSided = true;
  v.denserSide = s == Shading::environment;
}

void underAPoint(Variant& v, Shading s) {
  v.directionalLights = 0;
  v.pointLights = 1;
  v.pixelPosition = computesPixels(s);
}

Material& blended(VariantInputs& in) {
  in.material.alphaMode = AlphaMode::blend;
  return in.material;
}

void antiAliased(VariantInputs& in, AntiAliasing::Mode mode, int count) {
  in.look.antiAliasing = {mode, count};
}

/// The material has this texture, which gives these parameters.
void give(VariantInputs& in, std::optional<Texture> ParameterTextures::*texture, unsigned given,
          const Sampler& sampler = {}) {
  (in.material.parameterTextures.*texture) = Texture{0, 0, sampler};
  in.material.textured = given;
}

/// One texture at a place of its own gives these parameters.
void reads(Variant& v, bool Variant::*texture, unsigned given) {
  v.textured = given;
  v.*texture = true;
  v.parameterPlaceCount = 1;
}

using In = VariantInputs;
using Type = Light::Type;

struct Case {
  const char* name;
  void (*change)(In&);
  void (*expect)(Variant&, Shading);
};

constexpr Sampler ownSampler{Filter::nearest, Filter::linear, MipFilter::none, Wrap::clampToEdge,
                             Wrap::mirroredRepeat};

const Case cases[] = {
    {"nothing", [](VariantInputs&) {}, unchanged},
    {"unlit material", [](In& in) { in.material.unlit = true; }, unlit},
    {"points without normals",
     [](In& in) {
       in.mesh.topology = Topology::points;
       in.mesh.normals.clear();
     },
     unlit},
    {"lines with colours and emission",
     [](In& in) {
       in.mesh.topology = Topology::lines;
       in.mesh.normals.clear();
       in.mesh.colors.resize(4);
       in.material.emission = glm::dvec3(1);
       in.material.doubleSided = true;
     },
     [](Variant& v, Shading) {
       v = Variant{};
       v.unlit = v.vertexColors = v.emission = true;
     }},
    {"an unlit material that emits",
     [](In& in) {
       in.material.unlit = true;
       in.material.emission = glm::dvec3(1);
     },
     unlit},
    {"no lights", [](In& in) { in.look.noLights = true; }, dark},
    {"an empty list of lights", [](In& in) { in.look.light.emplace(); }, dark},
    {"no lights on an uneven two-sided mesh",
     [](In& in) {
       in.look.noLights = in.material.doubleSided = in.mesh.normalsMayCancel = true;
       in.world = scaling(glm::dvec3(1, 2, 3));
     },
     [](Variant& v, Shading s) {
       dark(v, s);
       v.vanishingNormal = v.twoSided = v.unevenScale = v.denserSide = v.pixelPosition;
     }},
    {"black light",
     [](In& in) { in.look.light.emplace(1, directional(glm::dvec3(0, 0, 1), glm::dvec3(0))); },
     dark},
    {"lights of every kind",
     [](In& in) {
       in.look.light = {lightOf(Type::spot), lightOf(Type::directional), lightOf(Type::point),
                        lightOf(Type::camera), lightOf(Type::point)};
     },
     [](Variant& v, Shading) {
       v.directionalLights = v.pointLights = 2;
       v.spotLights = 1;
     }},
    {"diffuse alone", [](In& in) { in.material.shading.specular = 0; }, withoutHighlight},
    {"diffuse alone under a point light",
     [](In& in) {
       in.material.shading.specular = 0;
       in.look.light = {lightOf(Type::point)};
     },
     [](Variant& v, Shading s) {
       v.specular = false;
       underAPoint(v, s);
     }},
    {"specular alone", [](In& in) { in.material.shading.diffuse = 0; },
     [](Variant& v, Shading) { v.diffuse = false; }},
    {"neither", [](In& in) { in.material.shading.diffuse = in.material.shading.specular = 0; },
     dark},
    {"pow", [](In& in) { in.look.highlight = Highlight::pow; },
     [](Variant& v, Shading) { v.highlight = Highlight::pow; }},
    {"pow without a highlight",
     [](In& in) {
       in.look.highlight = Highlight::pow;
       in.material.shading.specular = 0;
     },
     withoutHighlight},
    {"lyon", [](In& in) { in.look.highlight = HighlightForm(Highlight::lyon, 8); },
     [](Variant& v, Shading) { v.highlight = HighlightForm(Highlight::lyon, 8); }},
    {"none", [](In& in) { in.look.highlight = Highlight::none; }, withoutHighlight},
    {"forms by light: the brightest, whatever its type, first",
     [](In& in) {
       in.look.light = {lightOf(Type::spot), lightOf(Type::directional), lightOf(Type::point),
                        lightOf(Type::directional)};
       for (int i : {0, 1, 2, 3})  // spot 1, directional 4, point 3, directional 2
         (*in.look.light)[std::size_t(i)].intensity *= i == 0 ? 1.0 : 5.0 - i;
       in.look.highlight = Highlight::pow;
       in.look.highlight.add({Highlight::lyon, 8}, 2);
       in.look.highlight.add(Highlight::none, 3);
     },
     [](Variant& v, Shading) {
       v.directionalLights = 2;
       v.pointLights = v.spotLights = 1;
       v.highlight = Highlight::pow;
       v.dimmer = {{{Highlight::lyon, 8}, 1, 1, 0}, {Highlight::none, 2, 1, 0}};
     }},
    {"forms for lights that are not there",
     [](In& in) {
       in.look.highlight = Highlight::pow;
       in.look.highlight.add({Highlight::lyon, 8}, 1);
     },
     [](Variant& v, Shading) { v.highlight = Highlight::pow; }},
    {"gaussian for this material",
     [](In& in) {
       in.look.highlight = Highlight::pow;
       in.material.highlight = Highlight::gaussian;
     },
     [](Variant& v, Shading) { v.highlight = Highlight::gaussian; }},
    {"a form without exponent",
     [](In& in) {
       in.look.highlight = HighlightForm(Highlight::pade, 4);
       in.material.shading.exponent = 0;
     },
     unchanged},
    {"integer",
     [](In& in) {
       in.look.highlight = Highlight::integer;
       in.material.shading.exponent = 21;
     },
     [](Variant& v, Shading s) {
       const bool blinn = s == Shading::blinnPhong || s == Shading::environment;
       v.highlight = HighlightForm(Highlight::integer, blinn ? 84 : 21);
     }},
    {"integer with another exponent",
     [](In& in) {
       in.look.highlight = Highlight::integer;
       in.material.shading.exponent = 20.1;
     },
     unchanged},
    {"infinite viewer", [](In& in) { in.look.viewer = Viewer::infinite; }, parallel},
    {"orthographic", [](In& in) { in.orthographic = true; }, parallel},
    {"orthographic with a point light",
     [](In& in) {
       in.orthographic = true;
       in.look.light = {lightOf(Type::point)};
     },
     [](Variant& v, Shading s) {
       v.constantView = true;
       underAPoint(v, s);
     }},
    {"uneven scale", [](In& in) { in.world = scaling(glm::dvec3(1, 1, 1.001)); }, uneven},
    {"shear", [](In& in) { in.world[1][0] = 0.1; }, uneven},
    {"singular", [](In& in) { in.world = scaling(glm::dvec3(1, 1, 0)); }, uneven},
    {"rotation, mirror, translation and one tiny scale",
     [](In& in) {
       in.world = translation({1, 2, 3}) * rotation(1) * scaling(glm::dvec3(-1e-20, 1e-20, 1e-20));
     },
     unchanged},
    {"one huge scale", [](In& in) { in.world = rotation(2) * scaling(glm::dvec3(1e20)); },
     unchanged},
    {"vanishing normals", [](In& in) { in.mesh.normalsMayCancel = true; },
     [](Variant& v, Shading s) { v.vanishingNormal = computesPixels(s); }},
    {"vanishing normals seen in parallel",
     [](In& in) { in.mesh.normalsMayCancel = in.orthographic = true; },
     [](Variant& v, Shading s) {
       v.constantView = true;
       v.vanishingNormal = v.pixelPosition = computesPixels(s);
     }},
    {"double sided", [](In& in) { in.material.doubleSided = true; }, twoSided},
    {"--two-sided", [](In& in) { in.look.twoSided = true; }, twoSided},
    {"a normalised highlight", [](In& in) { in.look.normalization = Normalization::exact; },
     unchanged},
    {"a normalised highlight of an exponent from a texture",
     [](In& in) {
       in.look.normalization = Normalization::simple;
       give(in, &ParameterTextures::metallicRoughness, textured::exponent);
     },
     [](Variant& v, Shading) {
       v.normalized = true;
       v.normalization = Normalization::simple;
       reads(v, &Variant::metallicRoughnessTexture, textured::exponent);
     }},
    {"--specular-antialiasing",
     [](In& in) { in.look.specularAntialiasing = SpecularAntialiasing::kaplanyan; },
     [](Variant& v, Shading s) { v.specularAntialiasing = computesPixels(s); }},
    {"--specular-antialiasing without a highlight",
     [](In& in) {
       in.look.specularAntialiasing = SpecularAntialiasing::kaplanyan;
       in.material.shading.specular = 0;
     },
     withoutHighlight},
    {"an integer power that is filtered",
     [](In& in) {
       in.look.specularAntialiasing = SpecularAntialiasing::kaplanyan;
       in.look.highlight = Highlight::integer;
     },
     [](Variant& v, Shading s) {
       v.specularAntialiasing = computesPixels(s);
       if (!computesPixels(s)) v.highlight = HighlightForm(Highlight::integer, 20);
     }},
    {"vertex colours", [](In& in) { in.mesh.colors.resize(4); },
     [](Variant& v, Shading) { v.vertexColors = true; }},
    {"colour texture", [](In& in) { in.material.colorTexture.emplace(); },
     [](Variant& v, Shading) { v.colorTexture = true; }},
    {"colour texture with a sampler of its own",
     [](In& in) { in.material.colorTexture.emplace().sampler = ownSampler; },
     [](Variant& v, Shading) {
       v.colorTexture = true;
       v.samplers[0] = ownSampler;
     }},
    {"emission texture with a sampler of its own, without emission",
     [](In& in) { in.material.emissionTexture.emplace().sampler = ownSampler; }, unchanged},
    {"colour texture without coordinates",
     [](In& in) {
       in.material.colorTexture.emplace();
       in.mesh.texcoords.clear();
     },
     unchanged},
    {"emission", [](In& in) { in.material.emission = glm::dvec3(0, 0, 1e-9); },
     [](Variant& v, Shading) { v.emission = true; }},
    {"emission texture",
     [](In& in) {
       in.material.emission = glm::dvec3(1);
       in.material.emissionTexture.emplace();
     },
     [](Variant& v, Shading) { v.emission = v.emissionTexture = true; }},
    {"mask", [](In& in) { in.material.alphaMode = AlphaMode::mask; },
     [](Variant& v, Shading) { v.alphaMask = true; }},
    {"blend", [](In& in) { blended(in).alpha = 0.5; },
     [](Variant& v, Shading) { v.alphaBlend = true; }},
    {"blend with an alpha of 1", [](In& in) { blended(in); }, unchanged},
    {"blend with vertex colours that let something through",
     [](In& in) {
       blended(in);
       in.mesh.colors.assign(4, glm::vec4(1));
       in.mesh.colors[2].a = 0.5f;
     },
     [](Variant& v, Shading) { v.alphaBlend = v.vertexColors = true; }},
    {"blend with a texture of which nothing is known",
     [](In& in) { blended(in).colorTexture.emplace(); },
     [](Variant& v, Shading) { v.alphaBlend = v.colorTexture = true; }},
    {"blend with texels that are opaque where they show",
     [](In& in) {
       blended(in).colorTexture.emplace();
       in.mesh.opaqueTexels = true;
     },
     [](Variant& v, Shading) { v.colorTexture = true; }},
    {"metallic-roughness texture",
     [](In& in) {
       give(in, &ParameterTextures::metallicRoughness, textured::exponent | textured::metalness);
     },
     [](Variant& v, Shading) {
       reads(v, &Variant::metallicRoughnessTexture, textured::exponent | textured::metalness);
     }},
    {"metallic-roughness texture whose place numbers have taken",
     [](In& in) { in.material.parameterTextures.metallicRoughness.emplace(); }, unchanged},
    {"metallic-roughness texture beside a colour texture at the same place",
     [](In& in) {
       give(in, &ParameterTextures::metallicRoughness, textured::exponent);
       in.material.colorTexture.emplace();
     },
     [](Variant& v, Shading s) {
       const bool pixels = computesPixels(s);
       v.textured = textured::exponent;
       v.metallicRoughnessTexture = v.colorTexture = true;
       v.parameterPlaces[0] = pixels ? -1 : 0;
       v.parameterPlaceCount = pixels ? 0 : 1;
     }},
    {"occlusion texture with a sampler of its own",
     [](In& in) { give(in, &ParameterTextures::occlusion, textured::ambient, ownSampler); },
     [](Variant& v, Shading) {
       reads(v, &Variant::occlusionTexture, textured::ambient);
       v.samplers[4] = ownSampler;
     }},
    {"occlusion texture",
     [](In& in) { give(in, &ParameterTextures::occlusion, textured::ambient); },
     [](Variant& v, Shading) { reads(v, &Variant::occlusionTexture, textured::ambient); }},
    {"occlusion texture without ambient light",
     [](In& in) {
       give(in, &ParameterTextures::occlusion, textured::ambient);
       in.look.ambientLight = glm::dvec3(0);
     },
     unchanged},
    {"transmission texture",
     [](In& in) {
       in.material.shading.transmission = 0.5;
       give(in, &ParameterTextures::transmission, textured::transmission);
     },
     [](Variant& v, Shading s) {
       if (s != Shading::environment) return;
       reads(v, &Variant::transmissionTexture, textured::transmission);
       v.refraction = true;
     }},
    {"msaa:4", [](In& in) { antiAliased(in, AntiAliasing::Mode::msaa, 4); },
     [](Variant& v, Shading) { v.multisampled = true; }},
    {"msaa:1", [](In& in) { antiAliased(in, AntiAliasing::Mode::msaa, 1); }, unchanged},
    {"ssaa:4", [](In& in) { antiAliased(in, AntiAliasing::Mode::ssaa, 4); }, unchanged},
    {"sky", [](In& in) { in.look.environment = Environment::sky; },
     [](Variant& v, Shading s) {
       if (s == Shading::environment) v.environment = Environment::sky;
     }},
    {"schlick", [](In& in) { in.look.fresnel = Fresnel::schlick; },
     [](Variant& v, Shading s) {
       v.schlickFifth = s == Shading::environment;
       if (v.schlickFifth) v.fresnel = Fresnel::schlick;
     }},
    {"schlick with another exponent",
     [](In& in) {
       in.look.fresnel = Fresnel::schlick;
       in.look.schlickExponent = 4;
     },
     [](Variant& v, Shading s) {
       if (s == Shading::environment) v.fresnel = Fresnel::schlick;
     }},
    {"rational, for this material",
     [](In& in) {
       in.look.fresnel = Fresnel::schlick;
       in.material.fresnel = Fresnel::rational;
     },
     [](Variant& v, Shading s) {
       if (s == Shading::environment) v.fresnel = Fresnel::rational;
     }},
    {"metal",
     [](In& in) {
       in.look.fresnel = Fresnel::schlick;  // metals have no index, so this has no effect
       in.material.shading.metalness = 1;
     },
     [](Variant& v, Shading s) {
       v.dielectric = false;
       v.metal = s == Shading::environment;
     }},
    {"half a metal", [](In& in) { in.material.shading.metalness = 0.5; },
     [](Variant& v, Shading s) { v.metal = s == Shading::environment; }},
    {"thinner than the medium", [](In& in) { in.look.mediumIor = 1.6; },
     [](Variant& v, Shading s) { v.denserSide = s == Shading::environment; }},
    {"as thin as the medium, both sides",
     [](In& in) {
       in.look.mediumIor = in.material.shading.ior;
       in.look.twoSided = true;
     },
     [](Variant& v, Shading) { v.twoSided = true; }},
    {"transmission", [](In& in) { in.material.shading.transmission = 0.1; },
     [](Variant& v, Shading s) { v.refraction = s == Shading::environment; }},
};

TEST(Variants, SwitchEachFeatureForItsReasonAlone) {
  for (const Case& c : cases)
    for (Shading program : everyShading) {
      VariantInputs in = plainInputs(program);
      c.change(in);
      Variant expected = plainVariant(program);
      c.expect(expected, program);
      EXPECT_EQ(in.variant(), expected) << c.name << " under " << shadingName(program);
    }
}

TEST(Variants, ReasonsAndNamesTellTheSame) {
  for (const Case& c : cases)
    for (Shading program : everyShading) {
      VariantInputs in = plainInputs(program);
      c.change(in);
      const Variant v = in.variant();
      const std::vector<std::string> names = featureNames(v);
      for (const auto& reason : reasonsFor(v, in.mesh, in.material, in.look, in.orthographic)) {
        EXPECT_FALSE(reason.reason.empty());
        const bool named = std::any_of(names.begin(), names.end(), [&](const std::string& name) {
          return name == reason.feature || name.starts_with(reason.feature + ":");
        });
        EXPECT_EQ(named, reason.present)
            << c.name << ": " << reason.feature << " under " << shadingName(program);
      }
    }
}

}  // namespace glint::test::variant_test
