#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>

#include "glint/scene/look.h"
#include "glint/scene/scene.h"

namespace glint {

/// The part of a number's range that a slider covers; typed values may go beyond.
struct SliderRange {
  double min = 0.0, max = 1.0;
  bool logarithmic = false;
};

/// One number of a material: extras.glint, --material and the panel go by this table.
struct MaterialParameter {
  std::string_view name, help;
  double min, max;
  double ShadingParameters::*value;
  std::optional<double> MaterialEdit::*edit;
  std::string_view symbol = {};  ///< in docs/science.md
  SliderRange slider = {};
  unsigned textured = 0;  ///< its bit in Material::textured
};

/// Ambient, diffuse, specular, exponent, metalness, ior and transmission; `color` stands beside
/// them.
std::span<const MaterialParameter> materialParameters();

/// A texture that is part of what it stands beside, and can be switched off: it then counts as
/// white, or as a flat normal map.
struct SwitchedTexture {
  std::string_view name;  ///< in texts and in extras.glint; "on" or "off", true or false
  std::optional<Texture> Material::*texture;
  std::optional<bool> MaterialEdit::*edit;
  unsigned bit;  ///< in Material::switchedOff
};
std::span<const SwitchedTexture> switchedTextures();

/// Calls `visit` with the pointer to each member of MaterialEdit.
template <typename Visit>
void forEachEdit(Visit visit) {
  for (const MaterialParameter& p : materialParameters()) visit(p.edit);
  visit(&MaterialEdit::color);
  visit(&MaterialEdit::highlight);
  visit(&MaterialEdit::fresnel);
  for (const SwitchedTexture& t : switchedTextures()) visit(t.edit);
}

/// All textures that a material may have, whether it has them or not.
std::array<std::optional<Texture>*, 7> texturesOf(Material&);
std::array<const std::optional<Texture>*, 7> texturesOf(const Material&);

/// What a look makes of a scene's material: its own values with those of the edits whose keys are
/// of it (material_key.h), in their order.
/// An edited number takes the place of a texture that gave it. Under a normalization m_s is the
/// share from which it was converted, unless it is given.
Material editedMaterial(const Material&, const Look&);

/// The exponent of a material's lobe under a look: Phong's, or Blinn-Phong's.
double lobeExponent(const Material&, const Look&);

/// Throws InputError if an edit is of a material that the scene does not have.
void checkMaterialNames(const Scene&, const Look&);

}  // namespace glint
