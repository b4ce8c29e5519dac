#pragma once

#include <array>
#include <string>
#include <vector>

#include "glint/scene/look.h"
#include "glint/scene/scene.h"

namespace glint {

// Text keys that select the materials of an edit: the keys of Look::material, the part of
// --material before the colon, and the keys of "material" in a look file.
//
//     (nothing)   every material
//     NAME        all materials with that name
//     NAME#N      the N-th with that name, from 0, in the file's order
//     #N          the file's N-th material, from 0 (after the last comes glTF's default material)
//     "NAME"      a quoted name may contain anything, \" and \\ stand for " and \; a name that
//                 contains =, begins with " or ends in # and digits needs quotes: "a=b", "Red#2"#0
//
// If several keys select a material, those lower in this list take precedence.

/// The text in canonical form, without unnecessary quotation marks. Throws InputError if a quoted
/// name is unterminated or followed by anything but #N.
std::string materialKey(const std::string& text);

/// The position of the colon that ends the key at the beginning of `text`, as in "NAME:" or
/// "\"NAME\"#N:"; npos if there is none. The first '=' outside quotation marks comes after the key.
/// Throws InputError for unterminated quotation marks.
std::size_t endOfMaterialKey(const std::string& text);

/// The key that selects only this material of a scene: its name, or NAME#N if several share it.
std::string materialKey(const Material&);

/// The keys by which edits can reach a material, in ascending precedence.
std::array<std::string, 4> materialKeys(const Material&);

/// Whether the look contains an edit for the material, including one for all materials.
bool isEdited(const Material&, const Look&);

/// Sets index, nth and nameShared of each material of a scene.
void countMaterials(std::vector<Material>&);

/// Moves a look's edits by NAME#N and #N of each of the scene's materials to the key that
/// materialKey() gives for it, so that there is one place to edit.
void gatherMaterialEdits(Look&, const Scene&);

/// Sets in `to` everything that is set in `from`.
void mergeEdit(MaterialEdit& to, const MaterialEdit& from);

}  // namespace glint
