#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>

#include "glint/scene/look.h"
#include "glint/scene/scene.h"

namespace glint {

/// The part of a number's range that a slider covers; typed values may lie outside.
struct SliderRange {
  double min = 0.0, max = 1.0;
  bool logarithmic = false;
};

/// One number of a material; extras.glint, --material and the panel use this table.
struct MaterialParameter {
  std::string_view name, help;
  double min, max;
  double ShadingParameters::*value;
  std::optional<double> MaterialEdit::*edit;
  std::string_view symbol = {};  ///< in docs/science.md
  SliderRange slider = {};
  unsigned textured = 0;  ///< its bit in Material::textured
};

/// Ambient, diffuse, specular, exponent, metalness, ior and transmission. `color` is separate.
std::span<const MaterialParameter> materialParameters();

/// The key of Material::highlightShare in extras.glint. It is not edited: an edited m_s replaces
/// it.
inline constexpr std::string_view shareKey = "normalized-specular";

/// A texture that can be switched off: it then counts as white, or as a flat normal map.
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

/// All textures that a material can have, whether present or not.
std::array<std::optional<Texture>*, 7> texturesOf(Material&);
std::array<const std::optional<Texture>*, 7> texturesOf(const Material&);

/// A scene's material with those of the look's edits whose keys select it (material_key.h), applied
/// in order of precedence. An edited number replaces a texture that supplied it, and an edited m_s
/// the share that it was converted from.
Material withEdits(const Material&, const Look&);

/// The material as the look shows it: withEdits(), but with a normalization m_s is the share that
/// it was converted from, if it was.
Material editedMaterial(const Material&, const Look&);

/// The exponent of a material's lobe with a look: Phong's, or Blinn-Phong's.
double lobeExponent(const Material&, const Look&);

/// Throws InputError if an edit is for a material that the scene does not have.
void checkMaterialNames(const Scene&, const Look&);

}  // namespace glint
