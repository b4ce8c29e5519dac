#pragma once

#include <optional>
#include <string>
#include <vector>

#include "glint/render/draw_list.h"
#include "glint/scene/look.h"
#include "glint/scene/scene.h"

namespace glint {

/// A way of shading a scene: a program with forms of its lobe and its reflectance.
struct StudyVariant {
  std::string name;  ///< "phong lyon:8", "environment schlick"
  Shading program = Shading::phong;
  std::string highlight;  ///< as `--highlight` takes it
  std::string fresnel;    ///< as `--fresnel` takes it; empty except for the program environment
  Look look;
  /// The bound of its error, linear radiance, if --max-error chose it.
  std::optional<double> bound = {};

  bool operator==(const StudyVariant&) const = default;
};

/// What a study is restricted to: empty means all.
struct StudyFilter {
  std::string shading, highlight, fresnel;  ///< the only one, if given
  bool quick = false;                       ///< only a few numbers of the forms that have one
  bool isEmpty() const { return shading.empty() && highlight.empty() && fresnel.empty(); }
};

/// Whether any item's variant has a feature.
bool anyHas(const DrawList& list, bool Variant::*feature);

/// The texts of all forms of the lobe, or of the reflectance. Quick: of those with a number only
/// the ones with 4, 16 and 256.
std::vector<std::string> lobeForms(bool quick);
std::vector<std::string> reflectanceForms(bool quick);

/// Sets the forms of all materials, whatever the look or the model say about some of them.
void setForms(Look& look, const std::string& highlight, const std::string& fresnel);

/// The programs and forms that make a difference to a scene: no forms of the highlight if no
/// material has one, none of the reflectance without a dielectric, and none that draws the same as
/// an earlier one (such as a form that an exponent cannot have). Per face and per vertex, where
/// forms cost next to nothing, there are only those without a number. The program environment draws
/// its highlight in the exact form; blinn-phong has its own variants for the forms. If the look has
/// a budget (--max-error), the last variants are what is chosen for phong (or among the programs,
/// if the look's is auto), blinn-phong and environment, even if another variant draws the same.
std::vector<StudyVariant> studyVariants(const Scene& scene, const Bounds& bounds, const Look& look,
                                        const StudyFilter& filter);

/// The model that a program approximates, whose exact form per pixel is its truth: phong for flat,
/// gouraud and phong.
Shading modelOf(Shading program);

/// The look's resolution made so that its longer side has so many pixels.
glm::ivec2 resolutionOf(const Look& look, int longerSide);

/// A look in the exact forms of a program.
Look exactLook(const Look& look, Shading program);

}  // namespace glint
