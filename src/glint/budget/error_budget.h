#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "glint/scene/camera.h"
#include "glint/scene/look.h"
#include "glint/scene/scene.h"

namespace glint {

/// What --max-error chose for the materials of one name, and why.
struct FormChoice {
  std::string material;
  bool specular = false;     ///< they have a highlight, and `highlight` says by which form
  bool dielectric = false;   ///< they reflect an environment, and `fresnel` says by which form
  HighlightForms highlight;  ///< as --highlight takes it
  Fresnel fresnel = Fresnel::exact;
  double lobe = 0;         ///< error of the lobe's formula times m_s S sum of I, linear radiance
  double reflectance = 0;  ///< error of the reflectance's formula times the environment's radiance
  double interpolation = 0;  ///< of shading once per face or vertex in place of per pixel
  double rounding = 0;       ///< of single precision in all of the shading
  double bound = 0;          ///< their sum: no pixel is farther from the exact sum
  double cost = 0;           ///< of lobes and reflectance (glint/shading/costs.h), of all lights
  double exactCost = 0;      ///< what the exact forms would cost
  std::string reason;
};

/// A look without --max-error and without --shading auto: it draws what the choice says.
struct ResolvedLook {
  Look look;
  std::vector<FormChoice> choices;  ///< by material; empty without --max-error
  double bound = 0;                 ///< the largest of the choices
  std::string programReason;        ///< of --shading auto; otherwise empty
};

/// The look's max-error in linear radiance before exposure; nothing without one. N codes are
/// N / (255 * 12.92) after exposure: the steps between 8-bit codes are that wide at black and wider
/// elsewhere, so that a smaller error leaves every code within N of the exact one.
std::optional<double> errorBudget(const Look&);

/// Replaces the look's budget by the cheapest forms whose proven bounds keep within it, for each
/// material and, of the lobe, for brighter and dimmer lights (HighlightForms), and
/// --shading auto by the cheapest program that does: phong, or gouraud or flat where they come near
/// enough to it. The forms that the look asks for give way to those chosen. Where no form is within
/// the budget the exact one is taken, and `bound` is above the budget. A pure function of its
/// arguments and of the files that the look names (InputError if they cannot be read); about a
/// millisecond, and with `auto` a look at every triangle.
///
/// The bound is that of shading: of the sum and the environment's terms in linear light, before
/// exposure, at each sample, and of positions in single precision, which turn the directions to
/// near lamps and to a near eye, and of their interpolation and that of normals (varying_error.h).
/// Not in it: filtering of textures, frames of normal maps, the outline and needles; and points at
/// which the model itself jumps, where N.L rounds to the other side of 0, or what is left to
/// refract does or nearly does (criticalRing of glint/shading/bounds.h).
ResolvedLook resolveLook(const Scene&, const Bounds&, const Look&);

/// A scene as one picture of a sequence shows it.
struct LookAtScene {
  const Scene& scene;
  Bounds bounds;
  Look look;
};

/// One choice for pictures that follow each other, within the budget in each of them, so that
/// nothing jumps from one to the next. They differ in camera and pose, not in materials, lights and
/// budget. `picture(i)` is asked for in turn, up to three times around; what it gave need not
/// outlive the next call. `look` of the result is that of the first.
ResolvedLook resolveSequence(std::size_t count,
                             const std::function<LookAtScene(std::size_t)>& picture);

/// The look with what was chosen for it. `chosen` may be of another picture of a sequence, or of an
/// earlier state of the look: its forms are taken, its parameters are not.
Look withChoice(Look, const ResolvedLook& chosen);

/// The largest sum of intensities of lights that can light one point at once, per channel:
/// directional ones only if some normal sees them all.
glm::dvec3 activeIntensity(const std::vector<glm::dvec3>& directions,
                           const std::vector<glm::dvec3>& intensities);

}  // namespace glint
