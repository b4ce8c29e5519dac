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
  bool specular = false;     ///< they have a highlight, of the form `highlight`
  bool dielectric = false;   ///< they reflect an environment, by the form `fresnel`
  HighlightForms highlight;  ///< as --highlight takes it
  Fresnel fresnel = Fresnel::exact;
  double lobe = 0;         ///< error of the lobe's formula times m_s S sum of I, linear radiance
  double reflectance = 0;  ///< error of the reflectance's formula times the environment's radiance
  double interpolation = 0;  ///< of shading once per face or vertex instead of per pixel
  double rounding = 0;       ///< of single precision in all of the shading
  double bound = 0;          ///< the sum of these: no pixel is farther from the exact sum
  double cost = 0;           ///< of lobes and reflectance (glint/shading/costs.h), for all lights
  double exactCost = 0;      ///< what the exact forms would cost
  std::string reason;
};

/// A look in which --max-error and --shading auto are replaced by what was chosen for them.
struct ResolvedLook {
  Look look;
  std::vector<FormChoice> choices;  ///< by material; empty without --max-error
  double bound = 0;                 ///< the largest of the choices
  std::string programReason;        ///< of --shading auto; otherwise empty
};

/// The look's max-error in linear radiance before exposure; nothing if it has none. N codes are N /
/// (255 * 12.92) after exposure: the steps between 8-bit codes are that wide at black and wider
/// elsewhere, so that a smaller error leaves every code within N of the exact one.
std::optional<double> errorBudget(const Look&);

/// Replaces the look's budget by the cheapest forms whose proven bounds stay within it, for each
/// material, and for the lobe also for brighter and dimmer lights (HighlightForms). Replaces
/// --shading auto by the cheapest program that stays within it: phong, or gouraud or flat where
/// they come close enough to phong. The chosen forms replace those that the look asks for. Where no
/// form is within the budget, the exact one is taken and `bound` is above the budget. A pure
/// function of its arguments and of the files that the look names (InputError if they cannot be
/// read). Takes about a millisecond; with `auto`, a pass over every triangle.
///
/// The bound covers shading: the sum and the environment's terms in linear light, before exposure,
/// at each sample, and positions in single precision, which turn the directions to near lamps and
/// to a near eye. It does not cover texture filtering, the driver's interpolation of normals, the
/// outline, or points at which the model itself jumps: where N.L rounds to the other side of 0, or
/// at or near the critical angle of total reflection (criticalRing of glint/shading/bounds.h).
ResolvedLook resolveLook(const Scene&, const Bounds&, const Look&);

/// A scene as one picture of a sequence shows it.
struct LookAtScene {
  const Scene& scene;
  Bounds bounds;
  Look look;
};

/// One choice for all pictures of a sequence, within the budget in each of them, so that nothing
/// jumps from one to the next. The pictures may differ in camera and pose, but not in materials,
/// lights or budget. `picture(i)` is called for each picture in turn, up to three times over; its
/// result need not outlive the next call. `look` of the result comes from the first picture.
ResolvedLook resolveSequence(std::size_t count,
                             const std::function<LookAtScene(std::size_t)>& picture);

/// The look with a choice applied to it. `chosen` may come from another picture of the sequence, or
/// from an earlier state of the look: only its program and forms are taken.
Look withChoice(Look, const ResolvedLook& chosen);

/// The largest sum of intensities, per channel, of directional lights that can light one point at
/// once: those that some normal sees together.
glm::dvec3 activeIntensity(const std::vector<glm::dvec3>& directions,
                           const std::vector<glm::dvec3>& intensities);

}  // namespace glint
