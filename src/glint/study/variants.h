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
  std::string fresnel;    ///< as `--fresnel` takes it; empty but for the program environment
  Look look;
  /// Of what --max-error chooses: the bound of its error, linear radiance.
  std::optional<double> bound = {};

  bool operator==(const StudyVariant&) const = default;
};

/// What a study is asked to leave out: empty means all.
struct StudyFilter {
  std::string shading, highlight, fresnel;  ///< the only one, if given
  bool quick = false;                       ///< of the forms with a number only a few numbers
  bool isEmpty() const { return shading.empty() && highlight.empty() && fresnel.empty(); }
};

/// The texts of all forms of the lobe, or of the reflectance. Quick: of those with a number the
/// ones with 4 and 16.
std::vector<std::string> lobeForms(bool quick);
std::vector<std::string> reflectanceForms(bool quick);

/// Sets the forms of all materials, whatever the look or the model say of some of them.
void setForms(Look& look, const std::string& highlight, const std::string& fresnel);

/// The programs and forms that make a difference to a scene: no forms of a highlight that no
/// material has, none of the reflectance without a dielectric, none that is drawn like an earlier
/// one (such as a form that an exponent cannot have). Per face and per vertex, where they
/// cost next to nothing, only the forms without a number; the program environment draws its
/// highlight in the exact form, blinn-phong's forms being its own. Where the look has a budget
/// (--max-error) the last are what is chosen for phong (or among the programs, if the look's is
/// auto), blinn-phong and environment, also where another variant draws the same.
std::vector<StudyVariant> studyVariants(const Scene& scene, const Bounds& bounds, const Look& look,
                                        const StudyFilter& filter);

/// The model that a program's picture is an approximation of, whose exact form per pixel is its
/// truth: phong of flat, gouraud and phong.
Shading modelOf(Shading program);

/// A look in the exact forms of a program.
Look exactLook(const Look& look, Shading program);

}  // namespace glint
