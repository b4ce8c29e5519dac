#include "glint/render/features.h"

#include "glint/scene/look_text.h"
#include "glint/scene/material_parameters.h"

namespace glint {
namespace {

// The text of a variant's forms, with the exponent of an integer power.
std::string lobeText(const Variant& v) {
  const auto one = [](const HighlightForm& form) {
    return highlightText(form) +
           (row(form.form).wholePowers ? ":" + std::to_string(form.gamma) : "");
  };
  std::string text = one(v.highlight);
  int before = 0;
  for (const Variant::Dimmer& each : v.dimmer) {
    const int from = each.directional + each.point + each.spot;
    text += "/" + std::to_string(from - before) + "," + one(each.form);
    before = from;
  }
  return text;
}

std::string formReason(const Variant& v, const Material& material, const Look& look) {
  const HighlightForms asked = material.highlight.value_or(look.highlight);
  const std::string by = material.highlight ? "the material's highlight is " : "--highlight is ";
  const std::string text = by + highlightText(asked);
  if (v.dimmer.empty() && !asked.dimmer.empty() && asked.brightest.form == v.highlight.form)
    return text + ", and no lights remain for another form";
  if (asked.brightest.form == v.highlight.form) return text;
  if (material.textured & textured::exponent) return text + ", but a texture varies the exponent";
  if (v.specularAntialiasing) return text + ", but --specular-antialiasing varies the exponent";
  return lobeExponent(material, look) > 0
             ? text + ", but the exponent is not a whole number from 1 to 128"
             : text + ", but the exponent is 0";
}

using In = const FeatureContext&;

bool always(const Variant&) { return true; }
bool ofEnvironment(const Variant& v) { return !v.unlit && v.program == Shading::environment; }
bool ofPixels(const Variant& v) { return !v.unlit && isPerPixel(v.program); }

template <int Variant::*member>
std::string countOf(In in) {
  return std::to_string(in.variant.*member) + " of them";
}
std::string noSuchLight(In in) { return in.lights() > 0 ? "no such light" : in.noLight(); }

std::string noNormalTexture(In in) {
  return !in.material.normalTexture        ? "the material has none"
         : !isPerPixel(in.variant.program) ? "the program has one normal per face or vertex"
         : in.mesh.tangents.empty()        ? "the mesh has no coordinates for it"
                                           : "nothing uses the normal";
}

template <std::optional<Texture> ParameterTextures::*texture>
std::string noParameterTexture(In in) {
  return in.material.parameterTextures.*texture ? "nothing uses what it provides"
                                                : "the material has none";
}

// What differs from the default sampler, which a texture without one has.
template <std::size_t texture>
std::string samplerText(const Variant& v) {
  const Sampler& s = v.samplers[texture];
  std::string text;
  const auto add = [&](bool differs, const char* word) {
    if (differs) text += (text.empty() ? "" : ",") + std::string(word);
  };
  add(s.magnify == Filter::nearest, "magnify-nearest");
  add(s.minify == Filter::nearest, "minify-nearest");
  add(s.mip == MipFilter::none, "levels-none");
  add(s.mip == MipFilter::nearest, "levels-nearest");
  add(s.wrapS == Wrap::clampToEdge, "clamp-s");
  add(s.wrapS == Wrap::mirroredRepeat, "mirror-s");
  add(s.wrapT == Wrap::clampToEdge, "clamp-t");
  add(s.wrapT == Wrap::mirroredRepeat, "mirror-t");
  return text;
}
std::string samplerReason(In) { return "the texture's sampler"; }

std::string fresnelReason(In in) {
  return (in.material.fresnel ? "the material's fresnel is " : "--fresnel is ") +
         std::string(fresnelText(in.variant.fresnel));
}

// Missing initialisers are intended: a row states only what differs from the default.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
constexpr Feature table[] = {
    {.flag = &Variant::unlit,
     .define = "UNLIT",
     .name = "unlit",
     .yes = [](In in) -> std::string {
       return in.material.unlit ? "the material is unlit"
                                : "points and lines without normals are unlit";
     },
     .no = [](In) -> std::string { return "a lit material of a mesh with normals"; },
     .told = always},
    {.count = &Variant::directionalLights,
     .define = "DIRECTIONAL_LIGHTS",
     .name = "directional-lights",
     .yes = countOf<&Variant::directionalLights>,
     .no = noSuchLight},
    {.count = &Variant::pointLights,
     .define = "POINT_LIGHTS",
     .name = "point-lights",
     .yes = countOf<&Variant::pointLights>,
     .no = noSuchLight},
    {.count = &Variant::spotLights,
     .define = "SPOT_LIGHTS",
     .name = "spot-lights",
     .yes = countOf<&Variant::spotLights>,
     .no = noSuchLight},
    {.flag = &Variant::lightFalloff,
     .define = "LIGHT_FALLOFF",
     .name = "light-falloff",
     .yes = [](In) -> std::string { return "some light falls off with distance"; },
     .no = [](In) -> std::string { return "no light falls off with distance"; },
     .told = [](const Variant& v) { return v.pointLights + v.spotLights > 0; }},
    {.flag = &Variant::diffuse,
     .define = "DIFFUSE",
     .name = "diffuse",
     .yes = [](In) -> std::string { return "diffuse > 0"; },
     .no = [](In in) { return in.lights() > 0 ? "diffuse is 0" : in.noLight(); }},
    {.flag = &Variant::specular,
     .define = "SPECULAR",
     .name = "specular",
     .yes = [](In) -> std::string { return "specular > 0"; },
     .no =
         [](In in) {
           if (in.lights() == 0) return in.noLight();
           return std::string(in.material.shading.specular > 0 ? "highlight none"
                                                               : "specular is 0");
         },
     .form = lobeText,
     .formReason = [](In in) { return formReason(in.variant, in.material, in.look); }},
    {.flag = &Variant::specularAntialiasing,
     .define = "SPECULAR_ANTIALIASING",
     .name = "specular-antialiasing",
     .yes = [](In) -> std::string { return "--specular-antialiasing"; },
     .no = [](In) -> std::string { return "not requested"; },
     .told = [](const Variant& v) { return v.specularAntialiasing; },
     .form = [](const Variant& v) -> std::string { return v.toksvig ? "toksvig" : "kaplanyan"; },
     .formReason = [](In) -> std::string { return "--specular-antialiasing"; }},
    {.flag = &Variant::toksvig,
     .define = "TOKSVIG",
     .name = "normal-lengths",
     .yes = [](In) -> std::string { return "the normal map's levels say how far normals differ"; },
     .no = [](In) -> std::string { return "the pixel's own normals do"; },
     .told = [](const Variant& v) { return v.specularAntialiasing; }},
    {.flag = &Variant::constantView,
     .define = "CONSTANT_VIEW",
     .name = "constant-view",
     .yes = [](In in) -> std::string {
       return in.orthographic ? "the camera is orthographic: V, L + V and H once per draw"
                              : "--viewer infinite: V, L + V and H once per draw";
     },
     .no = [](In) -> std::string { return "perspective and a local viewer: V per point"; }},
    {.flag = &Variant::unevenScale,
     .define = "UNEVEN_SCALE",
     .name = "renormalized-vertex-normals",
     .yes = [](In) -> std::string { return "the transform scales unevenly"; },
     .no = [](In) -> std::string { return "the transform is a rotation with one scale"; }},
    {.flag = &Variant::pixelPosition,
     .define = "PIXEL_POSITION",
     .name = "pixel-position",
     .yes = [](In) -> std::string {
       return "the direction to viewer or lights changes over the surface";
     },
     .no = [](In) -> std::string { return "no direction changes over the surface"; },
     .told = ofPixels},
    {.flag = &Variant::vanishingNormal,
     .define = "VANISHING_NORMAL",
     .name = "vanishing-normals",
     .yes = [](In) -> std::string {
       return "some triangle's normals may cancel: the face's normal replaces them";
     },
     .no = [](In) -> std::string { return "no triangle's normals can cancel"; },
     .told = ofPixels},
    {.flag = &Variant::twoSided,
     .define = "TWO_SIDED",
     .name = "two-sided",
     .yes = [](In in) -> std::string {
       return in.look.twoSided ? "--two-sided" : "the material is doubleSided";
     },
     .no = [](In in) -> std::string {
       return in.material.doubleSided || in.look.twoSided ? "nothing depends on the side"
                                                          : "back faces are not drawn";
     }},
    {.flag = &Variant::vertexColors,
     .define = "VERTEX_COLORS",
     .name = "vertex-colors",
     .yes = [](In) -> std::string { return "the mesh has them"; },
     .no = [](In) -> std::string { return "the mesh has none"; },
     .told = always},
    {.flag = &Variant::colorTexture,
     .define = "COLOR_TEXTURE",
     .name = "color-texture",
     .yes = [](In) -> std::string { return "the material has a colour texture"; },
     .no = [](In) -> std::string { return "the material has none"; },
     .told = always,
     .form = samplerText<0>,
     .formReason = samplerReason},
    {.flag = &Variant::normalTexture,
     .define = "NORMAL_TEXTURE",
     .name = "normal-texture",
     .yes = [](In) -> std::string { return "the material has a normal map"; },
     .no = noNormalTexture,
     .form = samplerText<2>,
     .formReason = samplerReason},
    {.flag = &Variant::emission,
     .define = "EMISSION",
     .name = "emission",
     .yes = [](In) -> std::string { return "the material emits"; },
     .no = [](In) -> std::string { return "the material does not emit"; },
     .told = [](const Variant& v) { return !v.unlit || v.emission; }},
    {.flag = &Variant::emissionTexture,
     .define = "EMISSION_TEXTURE",
     .name = "emission-texture",
     .yes = [](In) -> std::string { return "the material has one"; },
     .no = [](In) -> std::string { return "the material has none"; },
     .told = [](const Variant& v) { return v.emission; },
     .form = samplerText<1>,
     .formReason = samplerReason},
    {.flag = &Variant::alphaMask,
     .define = "ALPHA_MASK",
     .name = "alpha-mask",
     .yes = [](In) -> std::string { return "alphaMode is MASK"; },
     .no = [](In) -> std::string { return "alphaMode is not MASK"; },
     .told = always},
    {.flag = &Variant::alphaBlend,
     .define = "ALPHA_BLEND",
     .name = "alpha-blend",
     .yes = [](In) -> std::string { return "alphaMode is BLEND"; },
     .no = [](In in) -> std::string {
       return in.material.alphaMode == AlphaMode::blend
                  ? "alphaMode is BLEND, but alpha is 1 everywhere"
                  : "alphaMode is not BLEND";
     },
     .told = always},
    {.flag = &Variant::metallicRoughnessTexture,
     .define = "METALLIC_ROUGHNESS_TEXTURE",
     .name = "metallic-roughness-texture",
     .yes = [](In) -> std::string {
       return "the material has one: it gives metalness, exponent, specular and diffuse";
     },
     .no = noParameterTexture<&ParameterTextures::metallicRoughness>,
     .form = samplerText<3>,
     .formReason = samplerReason},
    {.flag = &Variant::occlusionTexture,
     .define = "OCCLUSION_TEXTURE",
     .name = "occlusion-texture",
     .yes = [](In) -> std::string { return "the material has one: it gives ambient"; },
     .no = noParameterTexture<&ParameterTextures::occlusion>,
     .form = samplerText<4>,
     .formReason = samplerReason},
    {.flag = &Variant::specularTexture,
     .define = "SPECULAR_TEXTURE",
     .name = "specular-texture",
     .yes = [](In) -> std::string { return "the material has one: it gives specular"; },
     .no = noParameterTexture<&ParameterTextures::specular>,
     .form = samplerText<5>,
     .formReason = samplerReason},
    {.flag = &Variant::transmissionTexture,
     .define = "TRANSMISSION_TEXTURE",
     .name = "transmission-texture",
     .yes = [](In) -> std::string { return "the material has one: it gives transmission"; },
     .no = noParameterTexture<&ParameterTextures::transmission>,
     .form = samplerText<6>,
     .formReason = samplerReason},
    {.count = &Variant::parameterPlaceCount,
     .define = "PARAMETER_PLACES",
     .name = "parameter-places",
     .yes = [](In) -> std::string { return "parameter textures have their own coordinates"; },
     .no = [](In) -> std::string { return "none has its own coordinates"; },
     .told = [](const Variant& v) { return v.textured != 0; }},
    {.flag = &Variant::normalized,
     .define = "NORMALIZED",
     .name = "normalization",
     .yes = [](In) -> std::string { return "a texture gives exponent or specular"; },
     .no = [](In) -> std::string { return "no texture gives exponent or specular"; },
     .told = [](const Variant& v) { return v.normalized; },
     .form =
         [](const Variant& v) {
           return std::string(normalizationNames[std::size_t(v.normalization)]);
         },
     .formReason = [](In) -> std::string { return "--normalization"; }},
    {.flag = &Variant::dielectric,
     .define = "DIELECTRIC",
     .name = "fresnel",
     .yes = [](In) -> std::string { return "metalness < 1"; },
     .no = [](In) -> std::string { return "metalness is 1: no dielectric part"; },
     .told = ofEnvironment,
     .form = [](const Variant& v) { return std::string(fresnelText(v.fresnel)); },
     .formReason = fresnelReason},
    {.flag = &Variant::schlickFifth,
     .define = "SCHLICK_FIFTH",
     .name = "schlick-fifth",
     .yes = [](In) -> std::string { return "the exponent is 5: products, not pow"; },
     .no = [](In) -> std::string { return "--schlick-exponent is not 5"; },
     .told = [](const Variant& v) { return ofEnvironment(v) && v.fresnel == Fresnel::schlick; }},
    {.flag = &Variant::denserSide,
     .define = "DENSER_SIDE",
     .name = "denser-side",
     .yes = [](In in) -> std::string {
       return in.material.shading.ior < in.look.mediumIor
                  ? "ior is below that of the medium"
                  : "back faces show, and seen from inside, ior is above that of the medium";
     },
     .no = [](In in) -> std::string {
       return in.material.shading.ior == in.look.mediumIor
                  ? "ior is that of the medium"
                  : "only front faces show, and ior is above that of the medium";
     },
     .told = [](const Variant& v) { return ofEnvironment(v) && (v.dielectric || v.refraction); }},
    {.flag = &Variant::metal,
     .define = "METAL",
     .name = "metal",
     .yes = [](In) -> std::string { return "metalness > 0"; },
     .no = [](In) -> std::string { return "metalness is 0"; },
     .told = ofEnvironment},
    {.flag = &Variant::refraction,
     .define = "REFRACTION",
     .name = "refraction",
     .yes = [](In) -> std::string { return "transmission > 0"; },
     .no = [](In) -> std::string { return "transmission is 0"; },
     .told = ofEnvironment},
};
#pragma GCC diagnostic pop

std::string fullName(const Feature& f, const Variant& v) {
  std::string name(f.name);
  if (const std::string form = f.form ? f.form(v) : ""; !form.empty()) name += ":" + form;
  if (f.count) name += ":" + std::to_string(v.*f.count);
  return name;
}

}  // namespace

std::span<const Feature> features() { return table; }

int FeatureContext::lights() const {
  return variant.directionalLights + variant.pointLights + variant.spotLights;
}

std::string FeatureContext::noLight() const {
  const ShadingParameters& s = material.shading;
  return look.noLights                ? "--no-lights"
         : lightsOf(look).empty()     ? "no light is given"
         : s.diffuse + s.specular > 0 ? "every light has intensity 0"
                                      : "diffuse and specular are 0";
}

std::vector<FeatureReason> reasonsFor(const Variant& v, const Mesh& mesh, const Material& material,
                                      const Look& look, bool orthographic) {
  const FeatureContext in{v, mesh, material, look, orthographic};
  std::vector<FeatureReason> reasons;
  for (const Feature& f : table) {
    if (f.told ? !f.told(v) : v.unlit) continue;
    const bool present = f.value(v) > 0;
    reasons.push_back({std::string(f.name), present, present ? f.yes(in) : f.no(in)});
    if (present && f.form && !f.form(v).empty())
      reasons.push_back({fullName(f, v), true, f.formReason(in)});
  }
  return reasons;
}

std::vector<std::string> featureNames(const Variant& v) {
  std::vector<std::string> names;
  for (const Feature& f : table) {
    // The features of the program environment come last, after the environment's name.
    if (f.flag == &Variant::dielectric && ofEnvironment(v))
      names.push_back("environment:" + std::string(environmentText(v.environment)));
    if (f.value(v) > 0) names.push_back(fullName(f, v));
  }
  return names;
}

}  // namespace glint
