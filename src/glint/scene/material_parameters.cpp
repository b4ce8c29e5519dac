#include "glint/scene/material_parameters.h"

#include <algorithm>
#include <set>

#include "glint/image/error.h"
#include "glint/scene/material_key.h"

namespace glint {

std::span<const MaterialParameter> materialParameters() {
  using P = ShadingParameters;
  using E = MaterialEdit;
  static const MaterialParameter table[] = {
      {"ambient",
       "m_a: share of the ambient light",
       0,
       1e6,
       &P::ambient,
       &E::ambient,
       "m_a",
       {0, 2, false},
       textured::ambient},
      {"diffuse",
       "m_d: strength of diffuse reflection",
       0,
       1e6,
       &P::diffuse,
       &E::diffuse,
       "m_d",
       {0, 2, false},
       textured::diffuse},
      {"specular",
       "m_s: strength of the highlight",
       0,
       1e6,
       &P::specular,
       &E::specular,
       "m_s",
       {0, 2, false},
       textured::specular},
      {"exponent",
       "m_sp: Phong's exponent",
       0,
       1e6,
       &P::exponent,
       &E::exponent,
       "m_sp",
       {0, 10000, true},
       textured::exponent},
      {"metalness",
       "m_sm: 1 colours the highlight, 0 leaves it white",
       0,
       1,
       &P::metalness,
       &E::metalness,
       "m_sm",
       {0, 1, false},
       textured::metalness},
      {"ior", "n: index of refraction", 1e-3, 1e3, &P::ior, &E::ior, "n", {0.5, 4, false}},
      {"transmission",
       "t: share of the light that is transmitted; used by the program environment",
       0,
       1,
       &P::transmission,
       &E::transmission,
       "t",
       {0, 1, false},
       textured::transmission},
  };
  return table;
}

std::span<const SwitchedTexture> switchedTextures() {
  using M = Material;
  using E = MaterialEdit;
  static constexpr SwitchedTexture table[] = {
      {"color-texture", &M::colorTexture, &E::colorTexture, switchedOff::color},
      {"normal-texture", &M::normalTexture, &E::normalTexture, switchedOff::normal},
      {"emission-texture", &M::emissionTexture, &E::emissionTexture, switchedOff::emission},
  };
  return table;
}

std::array<std::optional<Texture>*, 7> texturesOf(Material& m) {
  ParameterTextures& p = m.parameterTextures;
  return {&m.colorTexture, &m.emissionTexture, &m.normalTexture, &p.metallicRoughness,
          &p.occlusion,    &p.specular,        &p.transmission};
}

std::array<const std::optional<Texture>*, 7> texturesOf(const Material& m) {
  const ParameterTextures& p = m.parameterTextures;
  return {&m.colorTexture, &m.emissionTexture, &m.normalTexture, &p.metallicRoughness,
          &p.occlusion,    &p.specular,        &p.transmission};
}

namespace {

void applyEdit(Material& edited, const MaterialEdit& edit) {
  for (const MaterialParameter& p : materialParameters())
    if (edit.*p.edit) {
      edited.shading.*p.value = *(edit.*p.edit);
      edited.textured &= ~p.textured;
    }
  if (edit.specular) edited.highlightShare.reset();
  for (const SwitchedTexture& t : switchedTextures())
    if (edit.*t.edit)
      edited.switchedOff =
          *(edit.*t.edit) ? edited.switchedOff & ~t.bit : edited.switchedOff | t.bit;
  if (edit.color) edited.shading.color = *edit.color;
  if (edit.highlight) edited.highlight = edit.highlight;
  if (edit.fresnel) edited.fresnel = edit.fresnel;
}

}  // namespace

Material withEdits(const Material& material, const Look& look) {
  Material edited = material;
  if (!look.material.empty()) {
    const auto keys = materialKeys(material);
    for (auto key = keys.begin(); key != keys.end(); ++key) {
      if (key != keys.begin() && std::find(keys.begin(), key, *key) != key) continue;
      const auto found = look.material.find(*key);
      if (found != look.material.end()) applyEdit(edited, found->second);
    }
  }
  for (const SwitchedTexture& t : switchedTextures())
    if (edited.switchedOff & t.bit) (edited.*t.texture).reset();
  return edited;
}

Material editedMaterial(const Material& material, const Look& look) {
  Material edited = withEdits(material, look);
  if (look.normalization != Normalization::none && edited.highlightShare)
    edited.shading.specular = *edited.highlightShare;
  return edited;
}

double lobeExponent(const Material& material, const Look& look) {
  const double alpha = material.shading.exponent;
  return usesBlinn(look.shading) ? look.blinnFactor * alpha : alpha;
}

void checkMaterialNames(const Scene& scene, const Look& look) {
  std::set<std::string> known;
  for (const Material& m : scene.materials)
    for (std::string& key : materialKeys(m)) known.insert(std::move(key));
  for (const auto& [key, edit] : look.material) {
    if (key.empty() || known.contains(key)) continue;
    constexpr std::size_t most = 20;
    std::string names;
    std::size_t count = 0;
    for (const Material& m : scene.materials) {
      if (m.name.empty()) continue;
      if (++count <= most) names += (names.empty() ? "'" : ", '") + materialKey(m) + "'";
    }
    if (count > most) names += " and " + std::to_string(count - most) + " more";
    throw InputError(
        "--material: " + scene.name + " has no material '" + key + "': " +
        (names.empty() ? "its materials have no names: leave NAME: out" : "use one of " + names));
  }
}

}  // namespace glint
