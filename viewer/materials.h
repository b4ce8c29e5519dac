#pragma once

#include <string>
#include <vector>

#include "glint/options/parameters.h"
#include "glint/scene/look.h"
#include "glint/scene/scene.h"

namespace glint::viewer {

/// The materials with which a scene draws something, in ascending order.
std::vector<int> drawnMaterials(const Scene&);

/// The key of a material in Look::material: its name, or "" for index -1, which means all.
std::string materialKey(const Scene&, int index);

/// For display: the name, or "all materials" for -1.
std::string materialLabel(const Scene&, int index);

/// A material as drawn. Index -1: with the values that all materials are set to, or the first
/// material's for the rest.
Material effectiveMaterial(const Scene&, const Look&, int index);

/// The parameters as drawn. Index -1: the values that all materials are set to, or the first
/// material's for the rest.
ShadingParameters effectiveParameters(const Scene&, const Look&, int index);

/// The smallest and the largest value of a parameter among the materials in use.
struct ValueSpread {
  double least = 0, most = 0;
  bool mixed() const { return least != most; }
};
ValueSpread spreadOf(const Scene&, const Look&, const MaterialParameter&);
/// Whether all materials in use have the same colour.
bool haveOneColor(const Scene&, const Look&);

/// Sets all parameters of a material.
void setParameters(Look&, const std::string& key, const ShadingParameters&);

/// Removes from a look its edits of materials and cameras that the scene does not have. Returns
/// them for a message; empty if none.
std::string dropMissing(Look&, const Scene&);

/// Removes one edit, or all; for "" those of every material.
void resetParameter(Look&, const std::string& key, const MaterialParameter&);
void resetColor(Look&, const std::string& key);
void resetTexture(Look&, const std::string& key, const SwitchedTexture&);
void resetMaterial(Look&, const std::string& key);

/// A material as text for the clipboard: the JSON of a glTF material's extras, {"glint": {...}}.
std::string materialText(const ShadingParameters&);

/// Applies a text to a material: any subset of the JSON of materialText, with or without the
/// "glint" around it, or the syntax of --material (key=value,...). Throws InputError and changes
/// nothing if it is neither.
void pasteMaterial(Look&, const std::string& key, const std::string& text);

}  // namespace glint::viewer
