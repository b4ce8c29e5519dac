#include "glint/budget/error_budget.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <utility>

#include "glint/budget/cost_file.h"
#include "glint/budget/form_choice.h"
#include "glint/budget/interpolation_bound.h"
#include "glint/budget/surface_errors.h"
#include "glint/render/variant.h"
#include "glint/scene/lights.h"
#include "glint/scene/look_text.h"
#include "glint/scene/material_key.h"
#include "glint/scene/material_parameters.h"

namespace glint {
namespace {

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

FormChoice choiceFor(const std::string& name, const SurfaceErrors& errors, const LitScene& lit,
                     double budget) {
  FormNeeds needs = errors.needs;
  needs.rest = errors.interpolation + errors.rounding;
  const ChosenForms forms = cheapestForms(needs, lit.reach, lit.look, lit.costs, lit.blinn, budget);
  FormChoice choice;
  choice.material = name;
  choice.specular = needs.specular;
  choice.dielectric = needs.dielectric;
  choice.highlight = forms.highlight;
  choice.fresnel = forms.fresnel;
  choice.lobe = forms.lobe;
  choice.reflectance = forms.reflectance;
  choice.interpolation = errors.interpolation;
  choice.rounding = forms.rounding + errors.rounding;
  choice.bound = needs.rest + forms.error();
  choice.cost = forms.cost;
  choice.exactCost = forms.exactCost;
  if (!forms.within)
    choice.reason =
        "no form is within " + number(budget) + ": exact, which is within " + number(choice.bound);
  else if (!needs.specular && !needs.dielectric)
    choice.reason = "no highlight and no reflectance: nothing to choose";
  else if (forms.cost == forms.exactCost)
    choice.reason = "no form cheaper than exact is within " + number(budget);
  else
    choice.reason = "the cheapest within " + number(budget) + ": " +
                    number(100 * forms.cost / forms.exactCost) + " % of exact";
  return choice;
}

// Adds the surfaces of one picture; returns how many of its triangles are blended. An interpolation
// bound above `enough` may be any value above it.
std::size_t addSurfaces(ErrorsByMaterial& byMaterial, const Scene& scene, const LitScene& lit,
                        Shading program, double enough) {
  std::size_t blended = 0;
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
    const Material material = editedMaterial(scene.materials[std::size_t(mesh.material)], lit.look);
    const Variant v = variantFor(mesh, material, instance.world, lit.look, lit.camera.orthographic);
    if (v.alphaBlend) blended += mesh.indices.size() / 3;
    if (v.unlit) continue;
    SurfaceErrors& errors = byMaterial[materialKey(material)];
    addSurface(errors, lit, material, mesh, v);
    if (program == lit.look.shading) continue;
    Material normalized = material;
    normalized.shading = brightestNumbers(material, v, lit.look);
    errors.interpolation =
        std::max(errors.interpolation, interpolationBound({scene, mesh, instance.world, normalized,
                                                           lit.look, lit.camera, lit.lights, v},
                                                          program, enough));
  }
  return blended;
}

// A form that all materials share goes into the look; different ones go into the materials' edits.
template <typename Form>
void spread(Look& look, const std::vector<FormChoice>& choices, bool FormChoice::*applies,
            Form FormChoice::*form, Form Look::*common, std::optional<Form> MaterialEdit::*own) {
  const FormChoice* first = nullptr;
  bool same = true;
  for (const FormChoice& c : choices) {
    if (!(c.*applies)) continue;
    if (first == nullptr) first = &c;
    same = same && c.*form == first->*form;
  }
  if (first == nullptr) return;
  if (same) {
    look.*common = first->*form;
    return;
  }
  for (const FormChoice& c : choices)
    if (c.*applies) look.material[c.material].*own = c.*form;
}

// Sets the exact forms everywhere.
void clearForms(Look& look) {
  for (auto& [name, edit] : look.material) edit.highlight.reset(), edit.fresnel.reset();
  std::erase_if(look.material, [](const auto& each) { return each.second == MaterialEdit{}; });
  look.highlight = Highlight::exact;
  look.fresnel = Fresnel::exact;
}

void setForms(Look& look, const std::vector<FormChoice>& choices) {
  spread(look, choices, &FormChoice::specular, &FormChoice::highlight, &Look::highlight,
         &MaterialEdit::highlight);
  spread(look, choices, &FormChoice::dielectric, &FormChoice::fresnel, &Look::fresnel,
         &MaterialEdit::fresnel);
}

// Combines two pictures into a bound of what lights bring to either.
void include(LightReach& reach, const LightReach& other) {
  for (std::size_t i = 0; i < reach.most.size() && i < other.most.size(); ++i)
    reach.most[i] = glm::max(reach.most[i], other.most[i]);
  reach.together = glm::max(reach.together, other.together);
}

ResolvedLook chosenFor(const ErrorsByMaterial& byMaterial, const LitScene& lit, Shading program,
                       double budget) {
  ResolvedLook resolved;
  resolved.look = lit.given;
  resolved.look.shading = program;
  for (const auto& [name, errors] : byMaterial) {
    resolved.choices.push_back(choiceFor(name, errors, lit, budget));
    resolved.bound = std::max(resolved.bound, resolved.choices.back().bound);
  }
  setForms(resolved.look, resolved.choices);
  return resolved;
}

}  // namespace

glm::dvec3 activeIntensity(const std::vector<glm::dvec3>& directions,
                           const std::vector<glm::dvec3>& intensities) {
  const std::size_t count = directions.size();
  glm::dvec3 all(0.0);
  for (const glm::dvec3& each : intensities) all += each;
  if (count < 2 || count > 32) return all;
  // The planes N.L = 0 divide the sphere into cells of normals that see the same lights. Each cell
  // has a corner where two planes meet; of the lights whose planes pass through it, a cell may see
  // all that lie on one side of a line.
  glm::dvec3 most(0.0);
  const auto tryNormal = [&](const glm::dvec3& normal) {
    glm::dvec3 sure(0.0), maybe(0.0);
    std::vector<std::size_t> edge;
    for (std::size_t i = 0; i < count; ++i) {
      const double c = glm::dot(normal, directions[i]);
      if (std::abs(c) <= 1e-9)
        edge.push_back(i);
      else if (c > 0)
        sure += intensities[i];
    }
    for (const std::size_t pivot : edge)
      for (const double side : {1.0, -1.0}) {
        const glm::dvec3 turned = side * glm::cross(normal, directions[pivot]);
        glm::dvec3 sum(0.0), along(0.0), against(0.0);
        for (const std::size_t i : edge) {
          const double c = glm::dot(turned, directions[i]);
          if (c > 1e-9)
            sum += intensities[i];
          else if (c >= -1e-9)
            (glm::dot(directions[i], directions[pivot]) > 0 ? along : against) += intensities[i];
        }
        maybe = glm::max(maybe, sum + glm::max(along, against));
      }
    most = glm::max(most, sure + maybe);
  };
  for (std::size_t i = 0; i < count; ++i) {
    tryNormal(directions[i]);
    for (std::size_t j = 0; j < i; ++j) {
      const glm::dvec3 corner = glm::cross(directions[i], directions[j]);
      if (!(glm::length(corner) > 1e-9)) continue;
      tryNormal(glm::normalize(corner));
      tryNormal(-glm::normalize(corner));
    }
  }
  return glm::min(most, all);
}

std::optional<double> errorBudget(const Look& look) {
  if (!look.maxError || !look.maxErrorInCodes) return look.maxError;
  return *look.maxError / (255 * 12.92) / std::exp2(look.exposure);
}

Look withChoice(Look look, const ResolvedLook& chosen) {
  look.shading = chosen.look.shading;
  if (!std::exchange(look.maxError, std::nullopt)) return look;
  look.maxErrorInCodes = false;
  look.costTable.clear();
  look.highlight = chosen.look.highlight;
  look.fresnel = chosen.look.fresnel;
  for (auto& [name, edit] : look.material) edit.highlight.reset(), edit.fresnel.reset();
  for (const auto& [name, edit] : chosen.look.material) {
    if (edit.highlight) look.material[name].highlight = edit.highlight;
    if (edit.fresnel) look.material[name].fresnel = edit.fresnel;
  }
  return look;
}

ResolvedLook resolveLook(const Scene& scene, const Bounds& bounds, const Look& look) {
  return resolveSequence(1, [&](std::size_t) { return LookAtScene{scene, bounds, look}; });
}

ResolvedLook resolveSequence(std::size_t count,
                             const std::function<LookAtScene(std::size_t)>& picture) {
  ResolvedLook resolved;
  resolved.look = picture(0).look;
  const bool automatic = resolved.look.shading == Shading::automatic;
  const std::optional<double> budget = errorBudget(resolved.look);
  resolved.look.shading = programOf(resolved.look);
  if (automatic) resolved.programReason = "phong: there is no --max-error";
  if (!budget) return resolved;

  std::vector<LitScene> litScenes;
  std::size_t vertices = 0;
  // The choice for one program, within the budget in every picture.
  const auto chosenBy = [&](Shading program) {
    ErrorsByMaterial byMaterial;
    LitScene all;
    std::size_t blended = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const LookAtScene p = picture(i);
      if (litScenes.size() == i) {
        Look plain = p.look;
        plain.shading = programOf(plain);
        plain.maxError.reset();
        plain.maxErrorInCodes = false;
        clearForms(plain);
        litScenes.push_back(litSceneFor(p.scene, p.bounds, plain));
        for (const Instance& each : p.scene.instances)
          vertices += i > 0 ? 0 : p.scene.meshes[std::size_t(each.mesh)].positions.size();
      }
      blended = std::max(blended, addSurfaces(byMaterial, p.scene, litScenes[i], program, *budget));
      if (i == 0)
        all = litScenes[0];
      else
        include(all.reach, litScenes[i].reach);
    }
    if (blended > 0) addBlending(byMaterial, blended, all.look);
    return chosenFor(byMaterial, all, program, *budget);
  };
  const Look asked = resolved.look;
  resolved = chosenBy(asked.shading);
  if (!automatic) return resolved;
  resolved.programReason = "phong: neither flat nor gouraud is within " + number(*budget);
  // Shading per face or vertex pays only if there are at most half as many of them as pixels.
  if (double(vertices) > 0.5 * asked.resolution.x * asked.resolution.y) {
    resolved.programReason = "phong: the model has more vertices than the picture has pixels";
    return resolved;
  }
  for (const Shading program : {Shading::flat, Shading::gouraud}) {
    ResolvedLook other = chosenBy(program);
    if (!(other.bound <= *budget) || other.choices.empty()) continue;
    other.programReason =
        program == Shading::flat
            ? "flat: every face has one normal, and its light is within " + number(*budget) +
                  " of phong's"
            : "gouraud: between vertices the light is within " + number(*budget) + " of phong's";
    return other;
  }
  return resolved;
}

}  // namespace glint
