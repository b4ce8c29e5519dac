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
#include "glint/budget/scene_distance.h"
#include "glint/render/environment_image.h"
#include "glint/render/variant.h"
#include "glint/scene/lights.h"
#include "glint/scene/look_text.h"
#include "glint/scene/material_key.h"
#include "glint/scene/material_parameters.h"
#include "glint/shading/angles.h"
#include "glint/shading/bounds.h"
#include "glint/shading/normalization.h"
#include "glint/shading/pbr_conversion.h"
#include "glint/shading/safe.h"
#include "glint/shading/specular_filter.h"

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

// What all surfaces have in common.
struct Setting {
  Look given;
  Look look;  // with the lights of the file
  Camera camera;
  std::vector<glint::Light> lights;
  LightReach reach;
  // How far rounding turns the direction to each light, and to the viewer; radians.
  std::vector<double> turns;
  double viewTurn = 0;
  double spotTurn = 0;        // the same, each times the turn of its light
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
  // Positions are floats in eye space, whose rounding is that of the largest coordinates on the way
  // to them: of the vertices (three products, three sums, the model's own coordinates) and of the
  // interpolation between them, 16 roundings in all. A lamp or an eye at the distance d sees
  // them turned by that over d.
  const double reach = glm::length(s.camera.eye - bounds.center) + 3 * bounds.radius;
  const double placeError = 16 * u * reach;
  const auto turnAt = [&](double distance) {
    return std::min(placeError / std::max(distance, 1e-300) + 2 * u, 2.0);
  };
  const SceneDistance distance(scene);
  if (!s.camera.orthographic && look.viewer == Viewer::local)
    s.viewTurn = turnAt(std::max(distance.to(s.camera.eye), s.camera.near));
  std::vector<glm::dvec3> directions, intensities;
  for (const glint::Light& light : s.lights) {
    const bool camera = light.type == glint::Light::Type::camera;
    if (camera || light.type == glint::Light::Type::directional) {
      const glm::dvec3 direction = safeNormalize(light.direction);
      directions.push_back(camera ? s.camera.axes * direction : direction);
      intensities.push_back(light.intensity);
      s.reach.most.push_back(light.intensity);
      s.turns.push_back(0);
      continue;
    }
    const double way = distance.to(light.position);
    s.turns.push_back(turnAt(way));
    // A lamp that weakens with distance is at its brightest where the scene comes nearest to it.
    double most = 1;
    if (light.fallsOff) {
      most = 1 / std::pow(std::max(way, 1e-6), 2);
    }
    s.reach.most.push_back(most * light.intensity);
    s.reach.together += s.reach.most.back();
    if (light.type == glint::Light::Type::spot) {
      const double range =
          std::cos(light.innerAngle * radians) - std::cos(light.outerAngle * radians);
      s.spotTurn += s.turns.back() * most * largest(light.intensity) * 2.0 / std::max(range, 1e-9);
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

// The exponents of the lobe that occur. A texture may hold every roughness up to the material's:
// then both ends, and some between them. Over the exponent the error of a form falls to its root
// (where there is one) and rises from there, so that an end has the largest.
// So do a pixel's, filtered by how the normals turn over it: from the widest lobe on.
std::vector<double> exponentsOf(const Material& material, const Variant& v, const Look& look) {
  const bool varies = (v.textured & textured::exponent) != 0;
  if (!varies && !v.specularAntialiasing) return {lobeExponent(material, look)};
  const bool blinn = usesBlinn(look.shading);
  const double scale = blinn ? look.blinnFactor : 1.0;
  double low = scale * exponentFromRoughness(material.parameterTextures.roughness);
  double high = scale * exponentFromRoughness(0);
  if (!varies) low = high = lobeExponent(material, look);
  if (v.specularAntialiasing) low = filteredLobe(low, blinn, 1e9).exponent;
  std::vector<double> exponents{low};
  constexpr int steps = 16;
  for (int i = 1; i <= steps; ++i)
    exponents.push_back(
        std::max(low, high * std::pow(std::max(low, 0.5) / high, 1.0 - double(i) / steps)));
  return exponents;
}

// The numbers of the material, and where textures give them the largest that they can give; m_s
// with what it is multiplied by, which grows with the exponent.
ShadingParameters brightestNumbers(const Material& material, const Variant& v, const Look& look) {
  ShadingParameters m = material.shading;
  if (v.textured & textured::diffuse) m.diffuse = 1;    // of pbr_conversion.h, as is
  if (v.textured & textured::specular) m.specular = 1;  // the bound of highlightPeak(), and of F0
  const std::vector<double> exponents = exponentsOf(material, v, look);
  m.specular *= lobeNormalization(look.normalization, usesBlinn(look.shading),
                                  *std::ranges::max_element(exponents));
  return m;
}

// What the turn of the directions to lamps and viewer adds to the sum: N.L moves by the turn, a
// lobe by the turn of both, 1 / d^2 by three times the turn (while that is small), a spot's ramp by
// its slope.
double turnError(const Setting& setting, const ShadingParameters& m,
                 const std::vector<double>& exponents, const glm::dvec3& C, const glm::dvec3& S,
                 const Variant& v) {
  const double matte = v.diffuse ? m.diffuse * largest(C) : 0.0;
  const double shine = v.specular ? m.specular * largest(S) : 0.0;
  const auto lobeMoves = [&](double turn) {
    double most = 0;
    for (const double alpha : exponents)
      most = std::max(most, lobeTurnBound(alpha, setting.blinn, turn));
    return std::min(most, 1.0);
  };
  double error = setting.spotTurn * (matte + shine);
  for (std::size_t i = 0; i < setting.lights.size(); ++i) {
    const double turn = setting.turns[i], most = largest(setting.reach.most[i]);
    error += most * (matte * std::min(turn, 1.0) + shine * lobeMoves(turn));
    if (setting.lights[i].fallsOff && turn > 0)
      error += most * (matte + shine) * (turn < 0.25 ? 3 * turn : 1e6);
  }
  return error + largest(setting.reach.together) * shine * lobeMoves(setting.viewTurn);
}

// How far rounding moves what filtering makes of a lobe, over its peak. With w = 1 / a^2, s^2 the
// pixel's variance and T the turn, w' = w / (1 + 2 w s^2 T). Each of two normals is off by 4 u, so
// that T is by 23 u sqrt(T), and w' by 2 w s^2 23 u sqrt(T) / (1 + 2 w s^2 T) of itself, at most
// 23 u s sqrt(w / 2) = 6.5 u sqrt(w); 12 u more are of T's own sums and of the formula. The peak
// moves with w', and the exponent n by (n + 2) / n of that, which changes a lobe by at most
// 1 / (e n) of the change; a lobe of an exponent below 0.05 is all but even.
double filterRounding(const std::vector<double>& exponents, bool blinn) {
  const double perBlinn = blinn ? 1 : 4;
  const double high = perBlinn * *std::ranges::max_element(exponents);
  const double low = perBlinn * std::max(*std::ranges::min_element(exponents), 0.05);
  return (6.5 * std::sqrt(high / 2 + 1) + 12) * u * (1 + (low + 2) / (2.718 * low));
}

void addSurface(Group& group, const Setting& setting, const Material& material, const Mesh& mesh,
                const Variant& v) {
  const ShadingParameters m = brightestNumbers(material, v, setting.look);
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
  std::vector<double> exponents;
  if (v.specular) {
    exponents = exponentsOf(material, v, setting.look);
    needs.specular = true;
    // What lets light through shows that much less of the sum.
    const bool veiled =
        v.program == Shading::environment && (v.textured & textured::transmission) == 0;
    const double shown = veiled ? 1 - m.transmission : 1.0;
    needs.shine = glm::max(needs.shine, shown * m.specular * S);
    for (const double exponent : exponents)
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
  // A normalization is as far off as the exponent, by another 6 u of its power of two, a division
  // and three products.
  if (v.normalized) rounding += 20.0 * u * shine;
  if (v.specularAntialiasing) rounding += filterRounding(exponents, setting.blinn) * shine;
  rounding += turnError(setting, m, exponents, C, S, v);
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
        1e-5 + (2e-6 + 2 * setting.viewTurn) * steep +
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

// Of one picture. Gives how many triangles of it are blended. Interpolation above `enough` is only
// known to be so.
std::size_t addSurfaces(Groups& groups, const Scene& scene, const Setting& setting, Shading program,
                        double enough) {
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
    Material normalized = material;
    normalized.shading = brightestNumbers(material, v, setting.look);
    group.interpolation = std::max(
        group.interpolation, interpolationBound({scene, mesh, instance.world, normalized,
                                                 setting.look, setting.camera, setting.lights, v},
                                                program, enough));
  }
  return blended;
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

// Of two pictures: a bound of what lights bring to either.
void include(LightReach& reach, const LightReach& other) {
  for (std::size_t i = 0; i < reach.most.size() && i < other.most.size(); ++i)
    reach.most[i] = glm::max(reach.most[i], other.most[i]);
  reach.together = glm::max(reach.together, other.together);
}

ResolvedLook chosenFor(Groups groups, const Setting& setting, Shading program, double budget) {
  ResolvedLook resolved;
  resolved.look = setting.given;
  resolved.look.shading = program;
  for (auto& [name, group] : groups) {
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
  if (automatic) resolved.programReason = "phong: no --max-error to keep within";
  if (!budget) return resolved;

  std::vector<Setting> settings;
  std::size_t vertices = 0;
  // By one program, within the budget in every picture.
  const auto chosenBy = [&](Shading program) {
    Groups groups;
    Setting all;
    std::size_t blended = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const LookAtScene p = picture(i);
      if (settings.size() == i) {
        Look plain = p.look;
        plain.shading = programOf(plain);
        plain.maxError.reset();
        plain.maxErrorInCodes = false;
        clearForms(plain);
        settings.push_back(settingFor(p.scene, p.bounds, plain));
        for (const Instance& each : p.scene.instances)
          vertices += i > 0 ? 0 : p.scene.meshes[std::size_t(each.mesh)].positions.size();
      }
      blended = std::max(blended, addSurfaces(groups, p.scene, settings[i], program, *budget));
      if (i == 0)
        all = settings[0];
      else
        include(all.reach, settings[i].reach);
    }
    if (blended > 0) addBlending(groups, blended, all.look);
    return chosenFor(std::move(groups), all, program, *budget);
  };
  const Look asked = resolved.look;
  resolved = chosenBy(asked.shading);
  if (!automatic) return resolved;
  resolved.programReason = "phong: neither flat nor gouraud is within " + number(*budget);
  // Per face or vertex pays while there are fewer of them than pixels.
  if (double(vertices) > 0.5 * asked.resolution.x * asked.resolution.y) {
    resolved.programReason = "phong: the model has more vertices than the picture pixels";
    return resolved;
  }
  for (const Shading program : {Shading::flat, Shading::gouraud}) {
    ResolvedLook other = chosenBy(program);
    if (!(other.bound <= *budget) || other.choices.empty()) continue;
    other.programReason =
        program == Shading::flat
            ? "flat: every face has one normal, and the light on it is within " + number(*budget) +
                  " of phong's"
            : "gouraud: between vertices the light is within " + number(*budget) + " of phong's";
    return other;
  }
  return resolved;
}

}  // namespace glint
