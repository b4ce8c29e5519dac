#pragma once

#include <array>
#include <string>
#include <vector>

#include "glint/scene/look.h"
#include "glint/scene/scene.h"

namespace glint {

// Which materials an edit is of, as a text: the keys of Look::material, what stands before the
// colon of --material, and the keys of "material" in a look file.
//
//     (nothing)   every material
//     NAME        all materials of that name
//     NAME#N      the N-th of that name, from 0, in the file's order
//     #N          the file's N-th material, from 0 (behind the last one, glTF's default material)
//     "NAME"      a name in quotation marks may hold anything, \" and \\ stand for " and \; a name
//                 that holds =, begins with " or ends in # and digits needs them: "a=b", "Red#2"#0
//
// Where several are of one material, the later of these lines stands above the earlier.

/// The text in its one form, without marks that it does not need.
/// Throws InputError where a quoted name does not end or is followed by anything but #N.
std::string materialKey(const std::string& text);

/// Where the key ends that stands at the beginning of `text`, as "NAME:" or "\"NAME\"#N:": the
/// place of its colon; npos if `text` begins with none. What follows holds the first '=' outside of
/// quotation marks. Throws InputError for quotation marks that do not end.
std::size_t endOfMaterialKey(const std::string& text);

/// The key that means this material of a scene and no other: its name; NAME#N where several have
/// it.
std::string materialKey(const Material&);

/// The keys by which edits may reach a material, those that stand above others last.
std::array<std::string, 4> materialKeys(const Material&);

/// Whether a key, in its one form, is of the material.
bool isOfMaterial(const std::string& key, const Material&);

/// Whether the look holds an edit of the material; one for every material counts too.
bool isEdited(const Material&, const Look&);

/// Counts the materials of a scene: index, nth and nameShared of each.
void countMaterials(std::vector<Material>&);

/// Brings what a look says of each of the scene's materials by NAME#N and #N under the key that
/// materialKey() gives it, so that there is one place to edit.
void gatherMaterialEdits(Look&, const Scene&);

/// Sets in `to` what `from` sets.
void mergeEdit(MaterialEdit& to, const MaterialEdit& from);

}  // namespace glint
