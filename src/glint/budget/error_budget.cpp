#include "glint/budget/error_budget.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>

#include "glint/budget/cost_file.h"
#include "glint/budget/form_choice.h"
#include "glint/budget/interpolation_bound.h"
#include "glint/render/environment_image.h"
#include "glint/render/variant.h"
#include "glint/scene/lights.h"
#include "glint/scene/look_text.h"
#include "glint/scene/material_key.h"
#include "glint/scene/material_parameters.h"
#include "glint/shading/bounds.h"
#include "glint/shading/pbr_conversion.h"
#include "glint/shading/safe.h"

namespace glint {
namespace {

using rounding::u;
constexpr double cosineError = 6e-7;  // of a dot product of rounded unit vectors, at most 10 u

// What the bounds read of the surfaces of a material's name.
struct Group {
  FormNeeds needs;
  double interpolation = 0;  // of shading once per face or vertex
  double rounding = 0;       // but for the lobes' and the reflectances'
  double radiance = 0;       // the most that such a surface shows
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

double distanceToEdge(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 way = b - a;
  const double square = glm::dot(way, way);
  const double t = square > 0 ? std::clamp(glm::dot(p - a, way) / square, 0.0, 1.0) : 0.0;
  return glm::length(p - a - t * way);
}

double distanceToTriangle(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b,
                          const glm::dvec3& c) {
  const glm::dvec3 n = glm::cross(b - a, c - a);
  const double size = glm::length(n);
  const bool above = size > 0 && glm::dot(glm::cross(b - a, p - a), n) >= 0 &&
                     glm::dot(glm::cross(c - b, p - b), n) >= 0 &&
                     glm::dot(glm::cross(a - c, p - c), n) >= 0;
  return above ? std::abs(glm::dot(p - a, n)) / size
               : std::min(
                     {distanceToEdge(p, a, b), distanceToEdge(p, b, c), distanceToEdge(p, c, a)});
}

// How near the lit surfaces of the scene come to a point.
double distanceToScene(const Scene& scene, const glm::dvec3& point) {
  double least = std::numeric_limits<double>::infinity();
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
    if (mesh.topology != Topology::triangles) continue;
    const auto at = [&](std::size_t i) {
      const glm::dvec3 x = glm::dvec3(mesh.positions[mesh.indices[i]]) + mesh.origin;
      return glm::dvec3(instance.world * glm::dvec4(x, 1.0));
    };
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
      least = std::min(least, distanceToTriangle(point, at(i), at(i + 1), at(i + 2)));
  }
  return least;
}

// What all surfaces have in common.
struct Setting {
  Look given;
  Look look;  // with the lights of the file
  Camera camera;
  std::vector<glint::Light> lights;
  LightReach reach;
  double spotSteepness = 0;   // the sum of the intensities of spots times the slope of their ramps
  Surroundings surroundings;  // of the program environment
  bool blinn = false;
  CostTable costs;
};

Setting settingFor(const Scene& scene, const Bounds& bounds, const Look& look) {
  Setting s;
  s.given = look;
  s.costs = costTableFor(look);
  s.given.costTable.clear();  // with the budget, which is gone already: the choice is made
  s.look = withFileLights(scene, look);
  s.camera = cameraFor(scene, bounds, look);
  s.blinn = usesBlinn(look.shading);
  if (look.shading == Shading::environment) s.surroundings = surroundingsOf(look);
  const std::vector<glint::Light> given = lightsOf(s.look);
  for (const std::size_t i : shiningLights(given)) s.lights.push_back(given[i]);
  std::vector<glm::dvec3> directions, intensities;
  for (const glint::Light& light : s.lights) {
    const bool camera = light.type == glint::Light::Type::camera;
    if (camera || light.type == glint::Light::Type::directional) {
      const glm::dvec3 direction = safeNormalize(light.direction);
      directions.push_back(camera ? s.camera.axes * direction : direction);
      intensities.push_back(light.intensity);
      s.reach.most.push_back(light.intensity);
      continue;
    }
    // A lamp that weakens with distance is at its brightest where the scene comes nearest to it.
    double most = 1;
    if (light.fallsOff) {
      const double way = distanceToScene(scene, light.position);
      most = 1 / std::pow(std::max(way, 1e-6), 2);
    }
    s.reach.most.push_back(most * light.intensity);
    s.reach.together += s.reach.most.back();
    if (light.type == glint::Light::Type::spot) {
      constexpr double radians = 0.017453292519943295;
      const double range =
          std::cos(light.innerAngle * radians) - std::cos(light.outerAngle * radians);
      s.spotSteepness += most * largest(light.intensity) * 2.0 / std::max(range, 1e-9);
    }
  }
  s.reach.together += activeIntensity(directions, intensities);
  return s;
}

// How far rounding turns the refracted direction, times the share 1 - F that is refracted: what
// lies along the surface by 2e-6 n, n the larger index over the smaller, and the root of x = 1 -
// |along|^2, whose square is off by 2e-6, by min(sqrt(2e-6), 2e-6 / sqrt(x)). Into the denser
// medium x is at least 1 - 1/n^2. Out of it, x is 0 at the critical angle, but there 1 - F is at
// most the slope of the reflectance times sqrt(x), save for a metal's share. Equal indices refract
// everything, at grazing incidence too.
double refractionError(const ShadingParameters& m, const Look& look, bool twoSided) {
  const double n = std::max(m.ior / look.mediumIor, look.mediumIor / m.ior), square = 2e-6;
  const double root = std::sqrt(square), rest = 1 - 1 / (n * n);
  double worst = std::min(root, square / std::sqrt(std::max(rest, 1e-12)));
  if (twoSided || m.ior < look.mediumIor) {
    const double exact = n > 1 ? 2 * (n * n + 1) / std::sqrt(n * n - 1) : 1e9;
    const double slope = std::max({exact, look.schlickExponent, 7.0});  // of any form
    worst = std::max(worst, std::min(root, slope * square + m.metalness * root));
  }
  return 2e-6 * n + worst;
}

// The numbers of the material, and where textures give them the largest that they can give.
ShadingParameters brightestNumbers(const Material& material, const Variant& v) {
  ShadingParameters m = material.shading;
  if (v.textured & textured::diffuse) m.diffuse = 1;    // of pbr_conversion.h, as is
  if (v.textured & textured::specular) m.specular = 1;  // the bound of highlightPeak()
  return m;
}

// The exponents of the lobe that occur. A texture may hold every roughness up to the material's:
// then both ends, and some between them. Over the exponent the error of a form falls to its root
// (where there is one) and rises from there, so that an end has the largest.
std::vector<double> exponentsOf(const Material& material, const Variant& v, const Look& look) {
  if (!(v.textured & textured::exponent)) return {lobeExponent(material, look)};
  const double scale = usesBlinn(look.shading) ? look.blinnFactor : 1.0;
  const double low = scale * exponentFromRoughness(material.parameterTextures.roughness);
  const double high = scale * exponentFromRoughness(0);
  std::vector<double> exponents{low};
  constexpr int steps = 16;
  for (int i = 1; i <= steps; ++i)
    exponents.push_back(
        std::max(low, high * std::pow(std::max(low, 0.5) / high, 1.0 - double(i) / steps)));
  return exponents;
}

void addSurface(Group& group, const Setting& setting, const Material& material, const Mesh& mesh,
                const Variant& v) {
  const ShadingParameters m = brightestNumbers(material, v);
  FormNeeds& needs = group.needs;
  glm::dvec3 C = m.color;
  if (v.vertexColors) {
    glm::vec4 most(0);
    for (const glm::vec4& color : mesh.colors) most = glm::max(most, color);
    C *= glm::dvec3(most);
  }
  const bool mixed = (v.textured & textured::metalness) != 0;  // any metalness up to this one
  const glm::dvec3 S = mixed ? glm::max(C, 1.0) : m.metalness * C + (1.0 - m.metalness);
  const double dielectric = mixed ? 1.0 : 1.0 - m.metalness;
  const glm::dvec3& light = setting.reach.together;
  if (v.specular) {
    needs.specular = true;
    // What lets light through shows that much less of the sum.
    const bool veiled =
        v.program == Shading::environment && (v.textured & textured::transmission) == 0;
    const double shown = veiled ? 1 - m.transmission : 1.0;
    needs.shine = glm::max(needs.shine, shown * m.specular * S);
    for (const double exponent : exponentsOf(material, v, setting.look))
      if (std::ranges::find(needs.exponents, exponent) == needs.exponents.end())
        needs.exponents.push_back(exponent);
  }
  const double shine = v.specular ? m.specular * largest(S * light) : 0.0;
  const double matte =
      largest(C * (m.ambient * setting.look.ambientLight + (v.diffuse ? m.diffuse : 0.0) * light));
  // Each light adds a rounding of the sum so far, and a few per term; N.L is off by cosineError,
  // and so is what a spot's ramp magnifies.
  double rounding = (8.0 + double(setting.lights.size())) * u * (matte + shine) +
                    cosineError * (v.diffuse ? m.diffuse * largest(C * light) : 0.0) +
                    cosineError * setting.spotSteepness *
                        ((v.diffuse ? m.diffuse * largest(C) : 0.0) +
                         (v.specular ? m.specular * largest(S) : 0.0)) +
                    2.0 * u * largest(material.emission);
  // An exponent of the relative error e changes a lobe by at most e / exp(1); the fourth power, two
  // products and a difference give 8 u, where the exponent is above 1, and at most 8 u of it below.
  if (v.textured & textured::exponent) rounding += 8.0 * u * shine;
  if (v.program == Shading::environment) {
    // F E(reflect) + t (1 - F) C E(refract): dF times the difference of two radiances.
    const auto [radiance, steep] = setting.surroundings;
    const double through = v.refraction ? std::max(1.0, largest(C)) : 1.0;
    if (v.dielectric) {
      needs.dielectric = true;
      needs.denserSide = needs.denserSide || v.denserSide;
      const FormNeeds::Mirror mirror{dielectric * radiance * through, m.ior, v.twoSided};
      if (std::ranges::find(needs.mirrors, mirror) == needs.mirrors.end())
        needs.mirrors.push_back(mirror);
    }
    // The reflected direction is off by 2e-6, the look-up by 1e-5, a metal's Schlick term by 5
    // cosines.
    rounding +=
        1e-5 + 2e-6 * steep +
        (m.metalness > 0 ? m.metalness * (1e-6 + 5.0 * cosineError) * radiance * through : 0.0);
    if (v.refraction)
      rounding += largest(C) * (1e-5 + steep * refractionError(m, setting.look, v.twoSided));
  }
  group.rounding = std::max(group.rounding, rounding);
  double radiance = matte + shine + largest(material.emission);
  if (v.program == Shading::environment)
    radiance += setting.surroundings.radiance * (1.0 + largest(C));
  group.radiance = std::max(group.radiance, radiance);
}

// What lies over one another is a mean of its layers, so that errors of shading do not grow. Each
// layer rounds alpha, its complement, two products and a sum, and alpha itself is interpolated:
// within 8 u of the brightest. No more layers are drawn than there are triangles.
void addBlending(std::map<std::string, Group>& groups, std::size_t triangles, const Look& look) {
  constexpr double mostLayers = 1024;  // of the renderer's
  double brightest = look.noBackground ? 0.0 : largest(look.backgroundColor);
  for (const auto& [name, group] : groups) brightest = std::max(brightest, group.radiance);
  const double rounding = 8.0 * u * std::min(double(triangles), mostLayers) * brightest;
  for (auto& [name, group] : groups) group.rounding += rounding;
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

FormChoice choiceFor(const std::string& name, Group& group, const Setting& setting, double budget) {
  FormNeeds& needs = group.needs;
  needs.rest = group.interpolation + group.rounding;
  const ChosenForms forms =
      cheapestForms(needs, setting.reach, setting.look, setting.costs, setting.blinn, budget);
  FormChoice choice;
  choice.material = name;
  choice.specular = needs.specular;
  choice.dielectric = needs.dielectric;
  choice.highlight = forms.highlight;
  choice.fresnel = forms.fresnel;
  choice.lobe = forms.lobe;
  choice.reflectance = forms.reflectance;
  choice.interpolation = group.interpolation;
  choice.rounding = forms.rounding + group.rounding;
  choice.bound = needs.rest + forms.error();
  choice.cost = forms.cost;
  choice.exactCost = forms.exactCost;
  if (!forms.within)
    choice.reason =
        "no form is within " + number(budget) + ": exact, which is within " + number(choice.bound);
  else if (!needs.specular && !needs.dielectric)
    choice.reason = "neither highlight nor reflectance: nothing to choose";
  else if (forms.cost == forms.exactCost)
    choice.reason = "nothing that costs less than exact is within " + number(budget);
  else
    choice.reason = "the least cost within " + number(budget) + ": " +
                    number(100 * forms.cost / forms.exactCost) + " % of exact";
  return choice;
}

using Groups = std::map<std::string, Group>;

Groups groupsOf(const Scene& scene, const Setting& setting, Shading program) {
  Groups groups;
  std::size_t blended = 0;
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
    const Material material =
        editedMaterial(scene.materials[std::size_t(mesh.material)], setting.look);
    const Variant v =
        variantFor(mesh, material, instance.world, setting.look, setting.camera.orthographic);
    if (v.alphaBlend) blended += mesh.indices.size() / 3;
    if (v.unlit) continue;
    Group& group = groups[materialKey(material)];
    addSurface(group, setting, material, mesh, v);
    if (program == setting.look.shading) continue;
    group.interpolation = std::max(
        group.interpolation, interpolationBound({scene, mesh, instance.world, material,
                                                 setting.look, setting.camera, setting.lights, v},
                                                program));
  }
  if (blended > 0) addBlending(groups, blended, setting.look);
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

// The exact forms everywhere.
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

ResolvedLook chosenFor(const Scene& scene, const Setting& setting, Shading program, double budget) {
  ResolvedLook resolved;
  resolved.look = setting.given;
  resolved.look.shading = program;
  for (auto& [name, group] : groupsOf(scene, setting, program)) {
    resolved.choices.push_back(choiceFor(name, group, setting, budget));
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
  clearForms(plain);
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
            ? "flat: every face has one normal, and the light on it is within " + number(budget) +
                  " of phong's"
            : "gouraud: between vertices the light is within " + number(budget) + " of phong's";
    return other;
  }
  return resolved;
}

}  // namespace glint
