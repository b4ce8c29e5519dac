#include "glint/scene/material_parameters.h"

#include <algorithm>

#include "glint/image/error.h"

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
       "t: share of the light that passes through; read by the program environment",
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

Material editedMaterial(const Material& material, const Look& look) {
  Material edited = material;
  for (const std::string& name : {std::string(), material.name}) {
    const auto found = look.material.find(name);
    if (found == look.material.end()) continue;
    const MaterialEdit& edit = found->second;
    for (const auto& p : materialParameters())
      if (edit.*p.edit) {
        edited.shading.*p.value = *(edit.*p.edit);
        edited.textured &= ~p.textured;
      }
    if (edit.color) edited.shading.color = *edit.color;
    if (edit.highlight) edited.highlight = edit.highlight;
    if (edit.fresnel) edited.fresnel = edit.fresnel;
  }
  return edited;
}

void checkMaterialNames(const Scene& scene, const Look& look) {
  for (const auto& [name, edit] : look.material) {
    // Named anew: Clang before 16 captures no structured binding.
    const auto has = [&name = name](const Material& m) { return m.name == name; };
    if (name.empty() || std::any_of(scene.materials.begin(), scene.materials.end(), has)) continue;
    std::string names;
    for (const Material& m : scene.materials)
      if (!m.name.empty()) names += (names.empty() ? "'" : ", '") + m.name + "'";
    throw InputError(
        "--material: " + scene.name + " has no material '" + name + "': " +
        (names.empty() ? "its materials have no names: leave NAME: out" : "use one of " + names));
  }
}

}  // namespace glint
