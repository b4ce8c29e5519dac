#include "glint/render/error_budget.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>

#include "glint/render/environment_image.h"
#include "glint/render/variant.h"
#include "glint/scene/lights.h"
#include "glint/scene/look_text.h"
#include "glint/scene/parameters.h"
#include "glint/shading/bounds.h"
#include "glint/shading/costs.h"
#include "glint/shading/safe.h"
#include "interpolation_bound.h"

namespace glint {
namespace {

constexpr double u = 0x1p-24;
constexpr double cosineError = 5e-7;  // of a dot product of rounded unit vectors

double largest(const glm::dvec3& v) { return std::max({v.x, v.y, v.z}); }

// What the bounds read of a drawn mesh and its material.
struct Surface {
  double exponent = 0;
  double highlight = 0;    // m_s S times the sum of the intensities, the largest channel
  double environment = 0;  // the radiance that an error of the reflectance is multiplied by
  double ior = 1;
  bool back = false;  // seen from within, too
  double interpolation = 0;
  double rounding = 0;  // but for the lobe's and the reflectance's
  bool operator==(const Surface&) const = default;
};

struct Group {
  bool specular = false, dielectric = false;
  std::vector<Surface> surfaces;
};

// How bright an environment is and how fast it changes with direction. A picture's changes are
// those of its filtering, of which the bound does not speak.
struct Surroundings {
  double radiance = 0, steep = 0;
};

Surroundings surroundingsOf(const Look& look) {
  if (const auto image = environmentImageFor(look)) {
    Surroundings s;
    for (const float value : image->levels.front().rgb)
      s.radiance = std::max(s.radiance, double(value));
    return s;
  }
  const BuiltinEnvironment map = look.environment == Environment::studio
                                     ? BuiltinEnvironment::studio
                                 : look.environment == Environment::sky ? BuiltinEnvironment::sky
                                                                        : BuiltinEnvironment::white;
  return {largestRadiance(map), steepestRadiance(map)};
}

// What all surfaces have in common.
struct Setting {
  Look given;
  Look look;  // with the lights of the file
  Camera camera;
  std::vector<glint::Light> lights;
  glm::dvec3 active{0.0};  // sum of intensities that can meet at a point
  int lightCount = 0;
  double spotSteepness = 0;   // the sum of the intensities of spots times the slope of their ramps
  Surroundings surroundings;  // of the program environment
  bool blinn = false;
};

Setting settingFor(const Scene& scene, const Bounds& bounds, const Look& look) {
  Setting s;
  s.given = look;
  s.look = withFileLights(scene, look);
  s.camera = cameraFor(scene, bounds, look);
  s.blinn = usesBlinn(look.shading);
  if (look.shading == Shading::environment) s.surroundings = surroundingsOf(look);
  s.lights = lightsOf(s.look);
  std::erase_if(s.lights, [](const glint::Light& l) { return l.intensity == glm::dvec3(0.0); });
  s.lightCount = int(s.lights.size());
  std::vector<glm::dvec3> directions, intensities;
  for (const glint::Light& light : s.lights) {
    const bool camera = light.type == glint::Light::Type::camera;
    if (camera || light.type == glint::Light::Type::directional) {
      const glm::dvec3 direction = safeNormalize(light.direction);
      directions.push_back(camera ? s.camera.axes * direction : direction);
      intensities.push_back(light.intensity);
      continue;
    }
    // A lamp that weakens with distance is at its brightest where the scene comes nearest to it.
    double most = 1;
    if (light.fallsOff) {
      const double way = glm::length(light.position - bounds.center) - bounds.radius;
      most = 1 / std::pow(std::max(way, 1e-6), 2);
    }
    s.active += most * light.intensity;
    if (light.type == glint::Light::Type::spot) {
      constexpr double radians = 0.017453292519943295;
      const double range =
          std::cos(light.innerAngle * radians) - std::cos(light.outerAngle * radians);
      s.spotSteepness += most * largest(light.intensity) * 2.0 / std::max(range, 1e-9);
    }
  }
  s.active += activeIntensity(directions, intensities);
  return s;
}

Surface surfaceFor(const Setting& setting, const Material& material, const Mesh& mesh,
                   const Variant& v) {
  const ShadingParameters& m = material.shading;
  Surface s;
  glm::dvec3 C = m.color;
  if (v.vertexColors) {
    glm::vec4 most(0);
    for (const glm::vec4& color : mesh.colors) most = glm::max(most, color);
    C *= glm::dvec3(most);
  }
  const glm::dvec3 S = m.metalness * C + (1.0 - m.metalness);
  s.exponent = lobeExponent(material, setting.look);
  const double shine = v.specular ? m.specular * largest(S * setting.active) : 0.0;
  const double matte = largest(
      C * (m.ambient * setting.look.ambientLight + (v.diffuse ? m.diffuse : 0.0) * setting.active));
  s.highlight = shine;
  s.ior = m.ior;
  s.back = v.twoSided;
  // Each light adds a rounding of the sum so far, and a few per term; N.L is off by cosineError,
  // and so is what a spot's ramp magnifies.
  s.rounding = (8.0 + setting.lightCount) * u * (matte + shine) +
               cosineError * (v.diffuse ? m.diffuse * largest(C * setting.active) : 0.0) +
               cosineError * setting.spotSteepness *
                   ((v.diffuse ? m.diffuse * largest(C) : 0.0) +
                    (v.specular ? m.specular * largest(S) : 0.0)) +
               2.0 * u * largest(material.emission);
  if (v.program != Shading::environment) return s;

  // F E(reflect) + t (1 - F) C E(refract): dF times the difference of two radiances.
  const auto [radiance, steep] = setting.surroundings;
  const double through = v.refraction ? std::max(1.0, largest(C)) : 1.0;
  if (v.dielectric) s.environment = (1.0 - m.metalness) * radiance * through;
  // The reflected direction is off by 2e-6, the look-up by 1e-5, a metal's Schlick term by 5
  // cosines.
  s.rounding +=
      1e-5 + 2e-6 * steep +
      (m.metalness > 0 ? m.metalness * (1e-6 + 5.0 * cosineError) * radiance * through : 0.0);
  if (v.refraction) {
    // sqrt(1 - |along|^2) is off by a square root next to the critical angle and at grazing
    // incidence, where all the less is refracted: (1 - F) is at most the slope of R times the same
    // root. Equal indices refract everything, at grazing incidence too.
    const double n = std::max(m.ior / setting.look.mediumIor, setting.look.mediumIor / m.ior);
    const double slope = n > 1.0 ? 2.0 * (n * n + 1.0) / std::sqrt(n * n - 1.0) : 1e9;
    const double off = 2e-6 * n + std::min(std::sqrt(4e-6), slope * n * 4e-6);
    s.rounding += largest(C) * (1e-5 + steep * off);
  }
  return s;
}

LobeForm lobeForm(Highlight form) { return LobeForm(int(form)); }
FresnelForm fresnelForm(Fresnel form) { return FresnelForm(int(form)); }
static_assert(int(LobeForm::gaussian) == int(Highlight::gaussian));
static_assert(int(LobeForm::lyonCross) == int(Highlight::lyonCross));
static_assert(int(FresnelForm::rational) == int(Fresnel::rational));

// What a form brings about on the surfaces of a group: the worst of its formula and of rounding.
double lobeErrors(const Group& group, const HighlightForm& form, bool blinn, double& rounding) {
  double worst = 0;
  rounding = 0;
  for (const Surface& s : group.surfaces) {
    const LobeForm lobe = lobeForm(form.form);
    worst = std::max(worst, s.highlight * lobeFormulaBound(lobe, form.gamma, s.exponent));
    rounding =
        std::max(rounding, s.highlight * lobeRoundingBound(lobe, form.gamma, s.exponent, blinn));
  }
  return worst;
}

double reflectanceErrors(const Group& group, Fresnel fresnel, const Look& look, double& rounding) {
  double worst = 0;
  rounding = 0;
  for (const Surface& s : group.surfaces) {
    const FresnelForm form = fresnelForm(fresnel);
    const double n1 = look.mediumIor, n2 = s.ior;
    worst =
        std::max(worst, s.environment * fresnelFormulaBound(form, n1, n2, look.schlickExponent));
    double r = fresnelRoundingBound(form, n1, n2, look.schlickExponent);
    if (s.back) r = std::max(r, fresnelRoundingBound(form, n2, n1, look.schlickExponent));
    rounding = std::max(rounding, s.environment * r);
  }
  return worst;
}

std::vector<HighlightForm> lobeCandidates(const Group& group) {
  std::vector<HighlightForm> forms{Highlight::exact};
  if (!group.specular) return forms;
  double least = 1e9;
  bool whole = true;
  for (const Surface& s : group.surfaces) {
    least = std::min(least, s.exponent);
    whole = whole && isIntegerPower(s.exponent);
  }
  forms.emplace_back(Highlight::pow);
  if (!(least > 0)) return forms;
  if (whole) forms.emplace_back(Highlight::integer);
  for (const Highlight form :
       {Highlight::lyon, Highlight::lyonTuned, Highlight::lyonCross, Highlight::pade})
    for (int gamma = 1; gamma <= 64; gamma *= 2) forms.emplace_back(form, gamma);
  forms.emplace_back(Highlight::gaussian);
  return forms;
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

FormChoice chooseForms(const std::string& name, const Group& group, const Setting& setting,
                       double budget) {
  const Look& look = setting.look;
  FormChoice choice;
  choice.material = name;
  choice.specular = group.specular;
  choice.dielectric = group.dielectric;
  double common = 0;
  for (const Surface& s : group.surfaces) {
    common = std::max(common, s.rounding);
    choice.interpolation = std::max(choice.interpolation, s.interpolation);
  }
  struct Lobe {
    HighlightForm form;
    double error, rounding, cost;
  };
  struct Reflectance {
    Fresnel form;
    double error, rounding, cost;
  };
  std::vector<Lobe> lobes;
  for (const HighlightForm& form : lobeCandidates(group)) {
    Lobe l{form, 0, 0, 0};
    if (group.specular) {
      l.error = lobeErrors(group, form, setting.blinn, l.rounding);
      for (const Surface& s : group.surfaces) {
        const int power = form.form == Highlight::integer ? int(s.exponent) : form.gamma;
        l.cost = std::max(l.cost, setting.lightCount * lobeCost(lobeForm(form.form), power));
      }
    }
    lobes.push_back(l);
  }
  std::vector<Reflectance> reflectances;
  for (const Fresnel form :
       {Fresnel::exact, Fresnel::schlick, Fresnel::schlickExp2, Fresnel::rational}) {
    Reflectance r{form, 0, 0, 0};
    if (group.dielectric) {
      r.error = reflectanceErrors(group, form, look, r.rounding);
      r.cost = fresnelCost(fresnelForm(form), look.schlickExponent);
    } else if (form != Fresnel::exact) {
      break;
    }
    reflectances.push_back(r);
  }
  // The exact forms come first: what costs as much does not replace them.
  int within = 0;
  const Lobe* bestLobe = &lobes.front();
  const Reflectance* bestReflectance = &reflectances.front();
  const auto boundOf = [&](const Lobe& l, const Reflectance& r) {
    return l.error + l.rounding + r.error + r.rounding + choice.interpolation + common;
  };
  double bestCost = bestLobe->cost + bestReflectance->cost;
  choice.exactCost = bestCost;
  double bestBound = boundOf(*bestLobe, *bestReflectance);
  for (const Lobe& l : lobes)
    for (const Reflectance& r : reflectances) {
      const double bound = boundOf(l, r), cost = l.cost + r.cost;
      if (!(bound <= budget)) continue;
      ++within;
      if (cost > bestCost || (cost == bestCost && bound >= bestBound)) continue;
      bestLobe = &l;
      bestReflectance = &r;
      bestCost = cost;
      bestBound = bound;
    }
  choice.highlight = bestLobe->form;
  choice.fresnel = bestReflectance->form;
  choice.lobe = bestLobe->error;
  choice.reflectance = bestReflectance->error;
  choice.rounding = bestLobe->rounding + bestReflectance->rounding + common;
  choice.bound = bestBound;
  choice.cost = bestCost;
  const std::size_t tried = lobes.size() * reflectances.size();
  if (within == 0)
    choice.reason =
        "no form is within " + number(budget) + ": exact, which is within " + number(choice.bound);
  else if (!group.specular && !group.dielectric)
    choice.reason = "neither highlight nor reflectance: nothing to choose";
  else if (bestCost == choice.exactCost)
    choice.reason = "nothing that costs less than exact is within " + number(budget);
  else
    choice.reason = "the least cost of " + std::to_string(within) + " of " + std::to_string(tried) +
                    " within " + number(budget) + ": " + number(100 * bestCost / choice.exactCost) +
                    " % of exact";
  return choice;
}

using Groups = std::map<std::string, Group>;

Groups groupsOf(const Scene& scene, const Setting& setting, Shading program) {
  Groups groups;
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
    const Material material =
        editedMaterial(scene.materials[std::size_t(mesh.material)], setting.look);
    const Variant v =
        variantFor(mesh, material, instance.world, setting.look, setting.camera.orthographic);
    if (v.unlit) continue;
    Surface surface = surfaceFor(setting, material, mesh, v);
    if (program != setting.look.shading)
      surface.interpolation = interpolationBound(
          {scene, mesh, instance.world, material, setting.look, setting.camera, setting.lights, v},
          program);
    Group& group = groups[material.name];
    group.specular = group.specular || v.specular;
    group.dielectric = group.dielectric || v.dielectric;
    if (std::find(group.surfaces.begin(), group.surfaces.end(), surface) == group.surfaces.end())
      group.surfaces.push_back(surface);
  }
  return groups;
}

// A form that all have in common stands in the look, several with their materials.
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

void setForms(Look& look, const std::vector<FormChoice>& choices) {
  for (auto& [name, edit] : look.material) edit.highlight.reset(), edit.fresnel.reset();
  std::erase_if(look.material, [](const auto& each) { return each.second == MaterialEdit{}; });
  look.highlight = Highlight::exact;
  look.fresnel = Fresnel::exact;
  spread(look, choices, &FormChoice::specular, &FormChoice::highlight, &Look::highlight,
         &MaterialEdit::highlight);
  spread(look, choices, &FormChoice::dielectric, &FormChoice::fresnel, &Look::fresnel,
         &MaterialEdit::fresnel);
}

ResolvedLook chosenFor(const Scene& scene, const Setting& setting, Shading program, double budget) {
  ResolvedLook resolved;
  resolved.look = setting.given;
  resolved.look.shading = program;
  for (const auto& [name, group] : groupsOf(scene, setting, program)) {
    resolved.choices.push_back(chooseForms(name, group, setting, budget));
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
  // The sets of lights that a normal sees are the cells that the planes N.L = 0 divide the sphere
  // into. Each has a corner where two planes meet; of the lights whose planes pass there, all that
  // lie on one side of a line may join in.
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

ResolvedLook resolveLook(const Scene& scene, const Bounds& bounds, const Look& look) {
  ResolvedLook resolved;
  resolved.look = look;
  const bool automatic = look.shading == Shading::automatic;
  resolved.look.shading = programOf(look);
  if (automatic) resolved.programReason = "phong: no --max-error to keep within";
  if (!look.maxError) return resolved;
  const double budget = *look.maxError;
  Look plain = resolved.look;
  plain.maxError.reset();
  const Setting setting = settingFor(scene, bounds, plain);
  const ResolvedLook perPixel = chosenFor(scene, setting, plain.shading, budget);
  resolved = perPixel;
  if (!automatic) return resolved;
  resolved.programReason = "phong: neither flat nor gouraud is within " + number(budget);
  // Per face or vertex pays while there are fewer of them than pixels.
  std::size_t vertices = 0;
  for (const Instance& i : scene.instances)
    vertices += scene.meshes[std::size_t(i.mesh)].positions.size();
  const double pixels = 0.5 * look.resolution.x * look.resolution.y;
  if (double(vertices) > pixels) {
    resolved.programReason = "phong: the model has more vertices than the picture pixels";
    return resolved;
  }
  for (const Shading program : {Shading::flat, Shading::gouraud}) {
    ResolvedLook other = chosenFor(scene, setting, program, budget);
    if (!(other.bound <= budget) || other.choices.empty()) continue;
    other.programReason =
        program == Shading::flat
            ? "flat: the normal of every face is constant, and so is all that it is lit by"
            : "gouraud: between vertices the light is within " + number(budget) + " of phong's";
    return other;
  }
  return resolved;
}

}  // namespace glint
