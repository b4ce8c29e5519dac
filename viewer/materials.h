#pragma once

#include <string>
#include <vector>

#include "glint/options/parameters.h"
#include "glint/scene/look.h"
#include "glint/scene/scene.h"

namespace glint::viewer {

/// Which materials of a scene something is drawn with, in ascending order.
std::vector<int> drawnMaterials(const Scene&);

/// The key of a material in Look::material: its name, or "" for index -1, which means all.
std::string materialKey(const Scene&, int index);

/// For lists: the name, or "all materials" for -1.
std::string materialLabel(const Scene&, int index);

/// A material as drawn. Index -1: with what all materials are set to, the first material's where
/// they are not.
Material effectiveMaterial(const Scene&, const Look&, int index);

/// The numbers as drawn. Index -1: those that all materials are set to, the first material's where
/// they are not.
ShadingParameters effectiveParameters(const Scene&, const Look&, int index);

/// The smallest and the largest value of a parameter among the materials that are drawn.
struct ValueSpread {
  double least = 0, most = 0;
  bool mixed() const { return least != most; }
};
ValueSpread spreadOf(const Scene&, const Look&, const MaterialParameter&);
/// Whether all materials that are drawn have one colour.
bool haveOneColor(const Scene&, const Look&);

/// Sets all parameters of a material.
void setParameters(Look&, const std::string& key, const ShadingParameters&);

/// Takes out of a look what it says of materials and cameras that the scene does not have. Returns
/// what that was, for a message; empty if nothing.
std::string dropMissing(Look&, const Scene&);

/// Takes back one edit, or all; for "" those of every material.
void resetParameter(Look&, const std::string& key, const MaterialParameter&);
void resetColor(Look&, const std::string& key);
void resetTexture(Look&, const std::string& key, const SwitchedTexture&);
void resetMaterial(Look&, const std::string& key);

/// A material as the text that is copied: the JSON of a glTF material's extras, {"glint": {...}}.
std::string materialText(const ShadingParameters&);

/// Sets what a text says of a material: the JSON of materialText, any subset, with or without the
/// "glint" around it, or the text of --material (key=value,...). Throws InputError and changes
/// nothing if it is neither.
void pasteMaterial(Look&, const std::string& key, const std::string& text);

}  // namespace glint::viewer
