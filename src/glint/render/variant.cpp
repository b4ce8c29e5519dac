#include "glint/render/variant.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "glint/render/opacity.h"
#include "glint/scene/material_parameters.h"
#include "glint/shading/lobe.h"

namespace glint {
namespace {

// The texture is read only where the mesh has the coordinates for it.
bool readsTexture(const Mesh& mesh, const std::optional<Texture>& texture) {
  return texture && std::size_t(texture->texcoord) < mesh.texcoords.size() &&
         !mesh.texcoords[std::size_t(texture->texcoord)].empty();
}

bool samePlace(const Texture& a, const Texture& b) {
  return a.texcoord == b.texcoord && a.transform == b.transform;
}

// Finds which parameter textures the program reads.
void readParameters(Variant& v, const Mesh& mesh, const Material& material, const Look& look) {
  const bool environment = look.shading == Shading::environment;
  const auto take = [&](unsigned bit, bool needed) {
    if (needed) v.textured |= material.textured & bit;
  };
  take(textured::ambient, look.ambientLight != glm::dvec3(0.0) && material.shading.ambient > 0);
  take(textured::diffuse, v.diffuse);
  take(textured::specular | textured::exponent, v.specular);
  take(textured::metalness, v.specular || environment);
  take(textured::transmission, v.refraction);
  if (v.textured == 0) return;
  const auto has = [&](unsigned bits) { return (v.textured & bits) != 0; };
  v.normalized =
      look.normalization != Normalization::none && has(textured::specular | textured::exponent);
  if (v.normalized) v.normalization = look.normalization;
  const ParameterTextures& t = material.parameterTextures;
  v.metallicRoughnessTexture =
      has(textured::diffuse | textured::specular | textured::exponent | textured::metalness) &&
      readsTexture(mesh, t.metallicRoughness);
  v.specularTexture = has(textured::specular) && readsTexture(mesh, t.specular);
  v.occlusionTexture = has(textured::ambient);
  v.transmissionTexture = has(textured::transmission);
  const bool reads[] = {v.metallicRoughnessTexture, v.occlusionTexture, v.specularTexture,
                        v.transmissionTexture};
  const auto textures = parameterTexturesOf(material);
  const std::vector<const Texture*> places = parameterPlaces(material);
  for (std::size_t i = 0; i < 4; ++i) {
    if (!reads[i]) continue;
    const Texture& texture = **textures[i];
    v.samplers[3 + i] = texture.sampler;
    if (isPerPixel(v.program) && v.colorTexture && samePlace(texture, *material.colorTexture)) {
      v.parameterPlaces[i] = -1;
      continue;
    }
    for (std::size_t k = 0; k < places.size(); ++k)
      if (samePlace(texture, *places[k])) v.parameterPlaces[i] = int(k);
    v.parameterPlaceCount = int(places.size());
  }
}

}  // namespace

void Variant::dropParameterTextures() {
  textured = 0;
  normalized = false;
  normalization = Normalization::none;
  metallicRoughnessTexture = occlusionTexture = specularTexture = transmissionTexture = false;
  parameterPlaces = {};
  parameterPlaceCount = 0;
  std::fill(samplers.begin() + 3, samplers.end(), Sampler{});
}

void Variant::dropEmission() {
  emission = emissionTexture = false;
  samplers[1] = {};
}

std::array<const std::optional<Texture>*, 4> parameterTexturesOf(const Material& material) {
  const ParameterTextures& t = material.parameterTextures;
  return {&t.metallicRoughness, &t.occlusion, &t.specular, &t.transmission};
}

std::vector<const Texture*> parameterPlaces(const Material& material) {
  std::vector<const Texture*> places;
  for (const std::optional<Texture>* texture : parameterTexturesOf(material)) {
    if (!*texture) continue;
    const auto same = [&](const Texture* place) { return samePlace(*place, **texture); };
    if (std::ranges::none_of(places, same)) places.push_back(&**texture);
  }
  return places;
}

unsigned texturedOn(const Mesh& mesh, const Material& material) {
  if (material.textured == 0) return 0;
  const ParameterTextures& t = material.parameterTextures;
  unsigned bits = 0;
  if (readsTexture(mesh, t.metallicRoughness))
    bits |= textured::diffuse | textured::specular | textured::exponent | textured::metalness;
  if (readsTexture(mesh, t.specular)) bits |= textured::specular;
  if (readsTexture(mesh, t.occlusion)) bits |= textured::ambient;
  if (readsTexture(mesh, t.transmission)) bits |= textured::transmission;
  return material.textured & bits;
}

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
  Light light;  // the default: from above and left of the viewer, in eye space
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

bool filtersHighlights(const Material& material, const Look& look) {
  if (!isPerPixel(look.shading)) return false;
  const auto& map = material.normalTexture;
  return look.specularAntialiasing == SpecularAntialiasing::kaplanyan ||
         (look.specularAntialiasing == SpecularAntialiasing::toksvig && map &&
          map->sampler.mip != MipFilter::none);
}

HighlightForms highlightOf(const Material& material, const Look& look) {
  const double exponent = lobeExponent(material, look);
  const bool varies =
      (material.textured & textured::exponent) != 0 || filtersHighlights(material, look);
  const auto drawn = [&](const HighlightForm& asked) -> HighlightForm {
    const HighlightRow& form = row(asked.form);
    if (!varies && !(exponent > 0) && !form.atZero) return Highlight::exact;
    if (form.hasTable && varies) return Highlight::exact;
    if (!form.wholePowers) return asked;
    if (varies || !isIntegerPower(exponent)) return Highlight::exact;
    return {asked.form, int(exponent)};
  };
  const HighlightForms asked = material.highlight.value_or(look.highlight);
  HighlightForms forms = drawn(asked.brightest);
  for (const HighlightForms::Dimmer& each : asked.dimmer) forms.add(drawn(each.form), each.from);
  return forms;
}

Fresnel fresnelOf(const Material& material, const Look& look) {
  return material.fresnel.value_or(look.fresnel);
}

Variant variantFor(const Mesh& mesh, const Material& given, const glm::dmat4& world,
                   const Look& look, bool orthographic) {
  const unsigned textured = texturedOn(mesh, given);
  const bool mapped = !mesh.tangents.empty() && readsTexture(mesh, given.normalTexture);
  std::optional<Material> own;
  if (textured != given.textured || (given.normalTexture && !mapped)) {
    own = given;
    own->textured = textured;
    if (!mapped) own->normalTexture.reset();
  }
  const Material& material = own ? *own : given;
  Variant v;
  v.program = programOf(look);
  v.unlit = material.unlit || (mesh.topology != Topology::triangles && mesh.normals.empty());
  v.twoSided = (material.doubleSided || look.twoSided) && !v.unlit;
  // Lines and points cover whole pixels, and drivers do not interpolate at offsets within them
  // (llvmpipe then reads what it has not written).
  v.multisampled = look.antiAliasing.mode == AntiAliasing::Mode::msaa &&
                   look.antiAliasing.count > 1 && mesh.topology == Topology::triangles;
  v.vertexColors = !mesh.colors.empty();
  v.colorTexture = readsTexture(mesh, material.colorTexture);
  if (v.colorTexture) v.samplers[0] = material.colorTexture->sampler;
  v.alphaMask = material.alphaMode == AlphaMode::mask;
  v.alphaBlend = isBlended(mesh, material);
  // KHR_materials_unlit shows the base colour only; points and lines without normals show the sum
  // of base colour and emission (glTF 2.0, section 3.9.7).
  v.emission = !material.unlit && material.emission != glm::dvec3(0.0);
  v.emissionTexture = v.emission && readsTexture(mesh, material.emissionTexture);
  if (v.emissionTexture) v.samplers[1] = material.emissionTexture->sampler;
  if (v.unlit) {
    v.program = Shading::phong;  // any program: all unlit variants are the same
    return v;
  }

  const bool pixels = isPerPixel(look.shading);
  const ShadingParameters& s = material.shading;
  const auto fromTexture = [&](unsigned bit) { return (textured & bit) != 0; };
  const bool shines = s.specular > 0 || fromTexture(textured::specular);
  const bool wantsLight = s.diffuse > 0 || shines;
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
  v.specular = highlights && shines;
  if (!v.specular) v.highlight = Highlight::exact, v.dimmer.clear();
  v.specularAntialiasing = v.specular && filtersHighlights(material, look);
  v.toksvig = v.specularAntialiasing && look.specularAntialiasing == SpecularAntialiasing::toksvig;
  const bool environment = look.shading == Shading::environment;
  v.constantView = orthographic || look.viewer == Viewer::infinite;
  v.unevenScale = !isSimilarity(glm::dmat3(world));
  if (environment) {
    v.environment = environmentOf(look);
    v.dielectric = s.metalness < 1 || fromTexture(textured::metalness);
    v.metal = s.metalness > 0;
    if (v.dielectric) v.fresnel = fresnelOf(material, look);
    v.schlickFifth = v.fresnel == Fresnel::schlick && look.schlickExponent == 5;
    v.refraction = s.transmission > 0;
    v.denserSide = (v.dielectric || v.refraction) &&
                   (s.ior < look.mediumIor || (v.twoSided && s.ior != look.mediumIor));
  }
  if (pixels) {
    v.vanishingNormal = mesh.normalsMayCancel;
    v.pixelPosition = v.pointLights + v.spotLights > 0 || v.vanishingNormal ||
                      ((v.specular || environment) && !v.constantView);
  }
  v.normalTexture = pixels && (lit || environment) && mapped;
  if (v.normalTexture) v.samplers[2] = material.normalTexture->sampler;
  readParameters(v, mesh, material, look);
  // Nothing depends on the surface's side where there is neither light nor environment.
  if (!lit && !environment)
    v.twoSided = v.vanishingNormal = v.pixelPosition = v.unevenScale = false;
  return v;
}

int lobeTableRows(const HighlightForm& form) {
  return row(form.form).hasTable ? form.gamma / 4 + 1 : 0;
}

int lobeTableRows(const Variant& v) {
  if (!v.specular) return 0;
  int rows = lobeTableRows(v.highlight);
  for (const Variant::Dimmer& each : v.dimmer) rows += lobeTableRows(each.form);
  return rows;
}

Variant attributeVariant(Variant variant, PixelOutput output) {
  variant.output = output;
  if (output == PixelOutput::position) variant.pixelPosition = true;
  return variant;
}

}  // namespace glint
