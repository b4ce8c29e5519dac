#include "glint/render/variant.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "glint/scene/look_text.h"
#include "glint/shading/lobe.h"

namespace glint {
namespace {

bool perPixel(Shading shading) {
  return shading == Shading::phong || shading == Shading::blinnPhong ||
         shading == Shading::environment;
}

// The texture is read only where the mesh has the coordinates for it.
bool readsTexture(const Mesh& mesh, const std::optional<Texture>& texture) {
  return texture && std::size_t(texture->texcoord) < mesh.texcoords.size() &&
         !mesh.texcoords[std::size_t(texture->texcoord)].empty();
}

// Of a variant: the text of the forms, with the exponent of an integer power.
std::string lobeText(const Variant& v) {
  const auto one = [](const HighlightForm& form) {
    return highlightText(form) +
           (form.form == Highlight::integer ? ":" + std::to_string(form.gamma) : "");
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
    return text + ", and no light is left for another form";
  if (asked.brightest.form == v.highlight.form) return text;
  return lobeExponent(material, look) > 0
             ? text + ", but the exponent is not a whole number from 1 to 128"
             : text + ", but the exponent is 0";
}

double transparencyOf(const Material& material, Shading shading) {
  return shading == Shading::environment ? material.transmission : 0.0;
}

}  // namespace

bool isSimilarity(const glm::dmat3& m) {
  const double scale = std::max({std::abs(m[0].x), std::abs(m[0].y), std::abs(m[0].z),
                                 std::abs(m[1].x), std::abs(m[1].y), std::abs(m[1].z),
                                 std::abs(m[2].x), std::abs(m[2].y), std::abs(m[2].z)});
  if (!(scale > 0)) return false;
  const glm::dmat3 n = m * (1 / scale);
  const glm::dmat3 gram = glm::transpose(n) * n;
  const double square = gram[0][0];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (std::abs(gram[i][j] - (i == j ? square : 0.0)) > 1e-6 * square) return false;
  return true;
}

std::vector<Light> lightsOf(const Look& look) {
  if (look.noLights) return {};
  if (look.light) return *look.light;
  Light light;  // the default: from above and the left of the viewer, in eye space
  light.type = Light::Type::camera;
  light.direction = {-0.5, 0.7, 1.0};
  return {light};
}

std::vector<std::size_t> shiningLights(const std::vector<Light>& lights) {
  const auto brightness = [&](std::size_t i) {
    const glm::dvec3& I = lights[i].intensity;
    return std::max({I.r, I.g, I.b});
  };
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < lights.size(); ++i)
    if (lights[i].intensity != glm::dvec3(0.0)) order.push_back(i);
  std::ranges::stable_sort(order, std::greater(), brightness);
  return order;
}

Shading programOf(const Look& look) {
  return look.shading == Shading::automatic ? Shading::phong : look.shading;
}

bool usesBlinn(Shading shading) {
  return shading == Shading::blinnPhong || shading == Shading::environment;
}

double lobeExponent(const Material& material, const Look& look) {
  const double alpha = material.shading.exponent;
  return usesBlinn(look.shading) ? look.blinnFactor * alpha : alpha;
}

HighlightForms highlightOf(const Material& material, const Look& look) {
  const double exponent = lobeExponent(material, look);
  const auto drawn = [&](const HighlightForm& asked) -> HighlightForm {
    if (asked.form == Highlight::pow || asked.form == Highlight::none) return asked;
    if (!(exponent > 0)) return Highlight::exact;
    if (asked.form != Highlight::integer) return asked;
    if (!isIntegerPower(exponent)) return Highlight::exact;
    return {Highlight::integer, int(exponent)};
  };
  const HighlightForms asked = material.highlight.value_or(look.highlight);
  HighlightForms forms = drawn(asked.brightest);
  for (const HighlightForms::Dimmer& each : asked.dimmer) forms.add(drawn(each.form), each.from);
  return forms;
}

Fresnel fresnelOf(const Material& material, const Look& look) {
  return material.fresnel.value_or(look.fresnel);
}

Variant variantFor(const Mesh& mesh, const Material& material, const glm::dmat4& world,
                   const Look& look, bool orthographic) {
  Variant v;
  v.program = programOf(look);
  v.unlit = material.unlit || mesh.topology != Topology::triangles;
  v.twoSided = (material.doubleSided || look.twoSided) && !v.unlit;
  v.multisampled = look.antiAliasing.mode == AntiAliasing::Mode::msaa && look.antiAliasing.count > 1;
  v.vertexColors = !mesh.colors.empty();
  v.colorTexture = readsTexture(mesh, material.colorTexture);
  v.alphaMask = material.alphaMode == AlphaMode::mask;
  v.alphaBlend = material.alphaMode == AlphaMode::blend;
  if (v.unlit) {
    v.program = Shading::phong;  // any: the unlit ones are all the same
    return v;
  }
  v.emission = material.emission != glm::dvec3(0.0);
  v.emissionTexture = v.emission && readsTexture(mesh, material.emissionTexture);

  const bool pixels = perPixel(programOf(look));
  const ShadingParameters& s = material.shading;
  const bool wantsLight = s.diffuse > 0 || s.specular > 0;
  const HighlightForms forms = highlightOf(material, look);
  const std::vector<Light> lights = lightsOf(look);
  std::vector<std::size_t> shining;
  if (wantsLight) shining = shiningLights(lights);
  bool highlights = false;
  v.highlight = forms.brightest;
  for (std::size_t i = 0; i < shining.size(); ++i) {
    const Light& light = lights[shining[i]];
    const HighlightForm form = forms.of(int(i));
    if (i > 0 && form != forms.of(int(i) - 1))
      v.dimmer.push_back({form, v.directionalLights, v.pointLights, v.spotLights});
    highlights = highlights || form.form != Highlight::none;
    switch (light.type) {
      case Light::Type::directional:
      case Light::Type::camera:
        ++v.directionalLights;
        break;
      case Light::Type::point:
        ++v.pointLights;
        break;
      case Light::Type::spot:
        ++v.spotLights;
        break;
    }
    v.lightFalloff = v.lightFalloff || light.fallsOff;
  }
  const bool lit = v.directionalLights + v.pointLights + v.spotLights > 0;
  v.diffuse = lit && s.diffuse > 0;
  v.specular = highlights && s.specular > 0;
  if (!v.specular) v.highlight = Highlight::exact, v.dimmer.clear();
  const bool environment = look.shading == Shading::environment;
  v.constantView = orthographic || look.viewer == Viewer::infinite;
  v.unevenScale = !isSimilarity(glm::dmat3(world));
  if (environment) {
    v.environment = environmentOf(look);
    v.dielectric = s.metalness < 1;
    v.metal = s.metalness > 0;
    if (v.dielectric) v.fresnel = fresnelOf(material, look);
    v.schlickFifth = v.fresnel == Fresnel::schlick && look.schlickExponent == 5;
    v.refraction = transparencyOf(material, look.shading) > 0 || v.alphaBlend;
    v.denserSide = (v.dielectric || v.refraction) &&
                   (s.ior < look.mediumIor || (v.twoSided && s.ior != look.mediumIor));
  }
  if (pixels) {
    v.vanishingNormal = mesh.normalsMayCancel;
    v.pixelPosition = v.pointLights + v.spotLights > 0 || v.vanishingNormal ||
                      ((v.specular || environment) && !v.constantView);
  }
  v.normalTexture = pixels && (lit || environment) && !mesh.tangents.empty() &&
                    readsTexture(mesh, material.normalTexture);
  // Nothing of the surface's side is left where there is neither light nor environment.
  if (!lit && !environment)
    v.twoSided = v.vanishingNormal = v.pixelPosition = v.unevenScale = false;
  return v;
}

Variant attributeVariant(Variant variant, PixelOutput output) {
  variant.output = output;
  if (output == PixelOutput::position) variant.pixelPosition = true;
  return variant;
}

std::vector<FeatureReason> reasonsFor(const Variant& v, const Mesh& mesh, const Material& material,
                                      const Look& look, bool orthographic) {
  std::vector<FeatureReason> reasons;
  const auto add = [&](std::string feature, bool present, std::string yes, std::string no) {
    reasons.push_back({std::move(feature), present, present ? std::move(yes) : std::move(no)});
  };
  add("unlit", v.unlit,
      mesh.topology == Topology::triangles ? "the material is unlit" : "points and lines are unlit",
      "a lit material of triangles");
  add("color-texture", v.colorTexture, "the material has a colour texture",
      "the material has none");
  add("vertex-colors", v.vertexColors, "the mesh has them", "the mesh has none");
  add("alpha-mask", v.alphaMask, "alphaMode is MASK", "alphaMode is not MASK");
  add("alpha-blend", v.alphaBlend, "alphaMode is BLEND", "alphaMode is not BLEND");
  if (v.unlit) return reasons;
  const ShadingParameters& s = material.shading;
  const int lights = v.directionalLights + v.pointLights + v.spotLights;
  const char* const none = look.noLights                ? "--no-lights"
                           : lightsOf(look).empty()     ? "no light is given"
                           : s.diffuse + s.specular > 0 ? "every light has intensity 0"
                                                        : "diffuse and specular are 0";
  const auto count = [&](const char* name, int n) {
    add(name, n > 0, std::to_string(n) + " of them", lights ? "no such light" : none);
  };
  count("directional-lights", v.directionalLights);
  count("point-lights", v.pointLights);
  count("spot-lights", v.spotLights);
  if (v.pointLights + v.spotLights > 0)
    add("light-falloff", v.lightFalloff, "some light weakens with distance",
        "no light weakens with distance");
  add("diffuse", v.diffuse, "diffuse > 0", lights ? "diffuse is 0" : none);
  add("specular", v.specular, "specular > 0",
      !lights          ? none
      : s.specular > 0 ? "highlight none"
                       : "specular is 0");
  if (v.specular) add("specular:" + lobeText(v), true, formReason(v, material, look), {});
  add("constant-view", v.constantView,
      orthographic ? "the camera is orthographic: V, L + V and H once per draw"
                   : "--viewer infinite: V, L + V and H once per draw",
      "perspective and a local viewer: V per point");
  add("renormalized-vertex-normals", v.unevenScale, "the transform scales unevenly",
      "the transform is a rotation with one scale");
  add("two-sided", v.twoSided, look.twoSided ? "--two-sided" : "the material is doubleSided",
      material.doubleSided || look.twoSided ? "nothing depends on the side"
                                            : "back faces are not drawn");
  add("normal-texture", v.normalTexture, "the material has a normal map",
      !material.normalTexture ? "the material has none"
      : !perPixel(v.program)  ? "the program has one normal a face or vertex"
      : mesh.tangents.empty() ? "the mesh has no coordinates for it"
                              : "nothing reads the normal");
  add("emission", v.emission, "the material emits", "the material does not emit");
  if (v.emission)
    add("emission-texture", v.emissionTexture, "the material has one", "the material has none");
  if (perPixel(v.program)) {
    add("pixel-position", v.pixelPosition,
        "the direction to viewer or lights changes over the surface",
        "no direction changes over the surface");
    add("vanishing-normals", v.vanishingNormal,
        "some triangle's normals may cancel: the face's stands in",
        "no triangle's normals can cancel");
  }
  if (v.program == Shading::environment) {
    add("fresnel", v.dielectric, "metalness < 1", "metalness is 1: no dielectric part");
    if (v.dielectric)
      add("fresnel:" + std::string(fresnelText(v.fresnel)), true,
          (material.fresnel ? "the material's fresnel is " : "--fresnel is ") +
              std::string(fresnelText(v.fresnel)),
          {});
    if (v.fresnel == Fresnel::schlick)
      add("schlick-fifth", v.schlickFifth, "the exponent is 5: products, not pow",
          "--schlick-exponent is not 5");
    if (v.dielectric || v.refraction)
      add("denser-side", v.denserSide,
          s.ior < look.mediumIor ? "ior is below that of the medium"
                                 : "back faces show, and within ior is above that of the medium",
          s.ior == look.mediumIor
              ? "ior is that of the medium"
              : "front faces alone show, whose ior is above that of the medium");
    add("metal", v.metal, "metalness > 0", "metalness is 0");
    add("refraction", v.refraction,
        v.alphaBlend ? "blended: transparency is 1 - alpha" : "transmission > 0", "opaque");
  }
  return reasons;
}

std::vector<std::string> featureNames(const Variant& v) {
  std::vector<std::string> names;
  const auto add = [&](bool has, const char* name) {
    if (has) names.emplace_back(name);
  };
  const auto count = [&](int n, const char* name) {
    if (n > 0) names.push_back(std::string(name) + ":" + std::to_string(n));
  };
  add(v.unlit, "unlit");
  count(v.directionalLights, "directional-lights");
  count(v.pointLights, "point-lights");
  count(v.spotLights, "spot-lights");
  add(v.lightFalloff, "light-falloff");
  add(v.diffuse, "diffuse");
  add(v.specular, ("specular:" + lobeText(v)).c_str());
  add(v.constantView && !v.unlit, "constant-view");
  add(v.unevenScale, "renormalized-vertex-normals");
  add(v.pixelPosition, "pixel-position");
  add(v.vanishingNormal, "vanishing-normals");
  add(v.twoSided, "two-sided");
  add(v.vertexColors, "vertex-colors");
  add(v.colorTexture, "color-texture");
  add(v.normalTexture, "normal-texture");
  add(v.emission, "emission");
  add(v.emissionTexture, "emission-texture");
  add(v.alphaMask, "alpha-mask");
  add(v.alphaBlend, "alpha-blend");
  if (v.program == Shading::environment && !v.unlit) {
    constexpr const char* maps[] = {"environment:studio", "environment:sky", "environment:white",
                                    "environment:image"};
    add(true, maps[int(v.environment)]);
    add(v.dielectric, ("fresnel:" + std::string(fresnelText(v.fresnel))).c_str());
    add(v.schlickFifth, "schlick-fifth");
    add(v.denserSide, "denser-side");
    add(v.metal, "metal");
    add(v.refraction, "refraction");
  }
  return names;
}

}  // namespace glint
