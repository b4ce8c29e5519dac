#include "glint/budget/surface_errors.h"

#include <algorithm>
#include <cmath>

#include "glint/budget/scene_distance.h"
#include "glint/render/environment_image.h"
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

// How far rounding turns the refracted direction, times the share 1 - F that is refracted. The part
// along the surface is off by 2e-6 n, with n the larger index over the smaller. The root of x = 1 -
// |along|^2, whose square is off by 2e-6, is off by min(sqrt(2e-6), 2e-6 / sqrt(x)). Into the
// denser medium, x is at least 1 - 1/n^2. Out of it, x is 0 at the critical angle, but there 1 - F
// is at most the slope of the reflectance times sqrt(x), except for a metal's share. Equal indices
// refract everything, even at grazing incidence.
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

// The exponents of the lobe that may occur. A texture may hold any roughness up to the material's:
// then both ends, and some values between them. As a function of the exponent, the error of a form
// falls to its root (if there is one) and rises from there, so that it is largest at an end. An
// exponent filtered by how the normals turn over the pixel varies likewise, from that of the widest
// lobe on.
std::vector<double> exponentsOf(const Material& material, const Variant& v, const Look& look) {
  const bool varies = (v.textured & textured::exponent) != 0;
  if (!varies && !v.specularAntialiasing) return {lobeExponent(material, look)};
  const bool blinn = usesBlinn(look.shading);
  const double scale = blinn ? look.blinnFactor : 1.0;
  double low = scale * exponentFromRoughness(material.parameterTextures.roughness);
  double high = scale * exponentFromRoughness(0);
  if (!varies) low = high = lobeExponent(material, look);
  if (v.toksvig)  // a code holds variances up to 1
    low = toksvigLobe(low, blinn, material.normalScale * material.normalScale).exponent;
  else if (v.specularAntialiasing)
    low = filteredLobe(low, blinn, 1e9).exponent;
  std::vector<double> exponents{low};
  constexpr int steps = 16;
  for (int i = 1; i <= steps; ++i)
    exponents.push_back(
        std::max(low, high * std::pow(std::max(low, 0.5) / high, 1.0 - double(i) / steps)));
  return exponents;
}

// The error of the sum from turned directions to lamps and viewer: N.L moves by the turn, a lobe by
// the turn of both, 1 / d^2 by three times the turn (while that is small), a spot's ramp by its
// slope.
double turnError(const LitScene& lit, const ShadingParameters& m,
                 const std::vector<double>& exponents, const glm::dvec3& C, const glm::dvec3& S,
                 const Variant& v) {
  const double matte = v.diffuse ? m.diffuse * largest(C) : 0.0;
  const double shine = v.specular ? m.specular * largest(S) : 0.0;
  const auto lobeMoves = [&](double turn) {
    double most = 0;
    for (const double alpha : exponents)
      most = std::max(most, lobeTurnBound(alpha, lit.blinn, turn));
    return std::min(most, 1.0);
  };
  double error = lit.spotTurn * (matte + shine);
  for (std::size_t i = 0; i < lit.lights.size(); ++i) {
    const double turn = lit.turns[i], most = largest(lit.reach.most[i]);
    error += most * (matte * std::min(turn, 1.0) + shine * lobeMoves(turn));
    if (lit.lights[i].fallsOff && turn > 0)
      error += most * (matte + shine) * (turn < 0.25 ? 3 * turn : 1e6);
  }
  return error + largest(lit.reach.together) * shine * lobeMoves(lit.viewTurn);
}

// The error of a filtered lobe from rounding, relative to its peak. With w = 1 / a^2, the pixel's
// variance s^2 and the turn T, w' = w / (1 + 2 w s^2 T). Each of two normals is off by 4 u, so that
// T is off by 23 u sqrt(T), and w' by 2 w s^2 23 u sqrt(T) / (1 + 2 w s^2 T) of itself, at most 23
// u s sqrt(w / 2) = 6.5 u sqrt(w); T's own sums and the formula add 12 u. The peak moves with w',
// and the exponent n by (n + 2) / n of that, which changes a lobe by at most 1 / (e n) of the
// change; a lobe with an exponent below 0.05 is almost constant.
//
// For Toksvig's filter, given its look-up: the width is off by 2 u, its square by 5 u, n' by 12 u
// and the peak by 20 u; a lobe is off by 1 / e of the error of n'.
double filterRounding(const std::vector<double>& exponents, bool blinn, bool toksvig) {
  if (toksvig) return 25 * u;
  const double perBlinn = blinn ? 1 : 4;
  const double high = perBlinn * *std::ranges::max_element(exponents);
  const double low = perBlinn * std::max(*std::ranges::min_element(exponents), 0.05);
  return (6.5 * std::sqrt(high / 2 + 1) + 12) * u * (1 + (low + 2) / (2.718 * low));
}

}  // namespace

LitScene litSceneFor(const Scene& scene, const Bounds& bounds, const Look& look) {
  LitScene s;
  s.given = look;
  s.costs = costTableFor(look);
  s.given.costTable.clear();  // like the budget, cleared already: the choice replaces both
  s.look = withFileLights(scene, look);
  s.camera = cameraFor(scene, bounds, look);
  s.blinn = usesBlinn(look.shading);
  if (look.shading == Shading::environment) s.surroundings = surroundingsOf(look);
  const std::vector<glint::Light> given = lightsOf(s.look);
  for (const std::size_t i : shiningLights(given)) s.lights.push_back(given[i]);
  // Positions are floats in eye space, rounded as the largest coordinates in their computation are:
  // those of the vertices (three products, three sums, the model's own coordinates) and of the
  // interpolation between them, 16 roundings in all. This turns the direction to a lamp or an eye
  // at the distance d by that over d.
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
    // A lamp that weakens with distance is brightest where the scene comes nearest to it.
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

ShadingParameters brightestNumbers(const Material& material, const Variant& v, const Look& look) {
  ShadingParameters m = material.shading;
  if (v.textured & textured::diffuse) m.diffuse = 1;    // the largest of pbr_conversion.h
  if (v.textured & textured::specular) m.specular = 1;  // the bound of highlightPeak(), and of F0
  const std::vector<double> exponents = exponentsOf(material, v, look);
  m.specular *= lobeNormalization(look.normalization, usesBlinn(look.shading),
                                  *std::ranges::max_element(exponents));
  return m;
}

void addSurface(SurfaceErrors& errors, const LitScene& lit, const Material& material,
                const Mesh& mesh, const Variant& v) {
  const ShadingParameters m = brightestNumbers(material, v, lit.look);
  FormNeeds& needs = errors.needs;
  glm::dvec3 C = m.color;
  if (v.vertexColors) {
    glm::vec4 most(0);
    for (const glm::vec4& color : mesh.colors) most = glm::max(most, color);
    C *= glm::dvec3(most);
  }
  const bool mixed = (v.textured & textured::metalness) != 0;  // any metalness up to this one
  const glm::dvec3 S = mixed ? glm::max(C, 1.0) : m.metalness * C + (1.0 - m.metalness);
  const double dielectric = mixed ? 1.0 : 1.0 - m.metalness;
  const glm::dvec3& light = lit.reach.together;
  std::vector<double> exponents;
  if (v.specular) {
    exponents = exponentsOf(material, v, lit.look);
    needs.specular = true;
    needs.varyingExponent = needs.varyingExponent || exponents.size() > 1;
    // A surface that transmits light shows that much less of the sum.
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
      largest(C * (m.ambient * lit.look.ambientLight + (v.diffuse ? m.diffuse : 0.0) * light));
  // Each light adds a rounding of the sum so far, and a few per term; N.L is off by cosineError,
  // and so is the cosine that a spot's ramp magnifies.
  double rounding = (8.0 + double(lit.lights.size())) * u * (matte + shine) +
                    cosineError * (v.diffuse ? m.diffuse * largest(C * light) : 0.0) +
                    cosineError * lit.spotSteepness *
                        ((v.diffuse ? m.diffuse * largest(C) : 0.0) +
                         (v.specular ? m.specular * largest(S) : 0.0)) +
                    2.0 * u * largest(material.emission);
  // An exponent with the relative error e changes a lobe by at most e / exp(1). The fourth power,
  // two products and a difference give 8 u where the exponent is above 1; below, they change the
  // lobe by at most 8 u.
  if (v.textured & textured::exponent) rounding += 8.0 * u * shine;
  // A normalization is as far off as the exponent, and by another 6 u from its power of two, a
  // division and three products.
  if (v.normalized) rounding += 20.0 * u * shine;
  if (v.specularAntialiasing) rounding += filterRounding(exponents, lit.blinn, v.toksvig) * shine;
  rounding += turnError(lit, m, exponents, C, S, v);
  if (v.program == Shading::environment) {
    // F E(reflect) + t (1 - F) C E(refract): an error dF counts times the difference of two
    // radiances.
    const auto [radiance, steep] = lit.surroundings;
    const double through = v.refraction ? std::max(1.0, largest(C)) : 1.0;
    if (v.dielectric) {
      needs.dielectric = true;
      needs.denserSide = needs.denserSide || v.denserSide;
      const FormNeeds::Mirror mirror{dielectric * radiance * through, m.ior, v.twoSided};
      if (std::ranges::find(needs.mirrors, mirror) == needs.mirrors.end())
        needs.mirrors.push_back(mirror);
    }
    // The reflected direction is off by 2e-6, the look-up by 1e-5, a metal's Schlick term by 5
    // cosine errors.
    rounding +=
        1e-5 + (2e-6 + 2 * lit.viewTurn) * steep +
        (m.metalness > 0 ? m.metalness * (1e-6 + 5.0 * cosineError) * radiance * through : 0.0);
    if (v.refraction)
      rounding += largest(C) * (1e-5 + steep * refractionError(m, lit.look, v.twoSided));
  }
  errors.rounding = std::max(errors.rounding, rounding);
  double radiance = matte + shine + largest(material.emission);
  if (v.program == Shading::environment) radiance += lit.surroundings.radiance * (1.0 + largest(C));
  errors.radiance = std::max(errors.radiance, radiance);
}

void addBlending(ErrorsByMaterial& byMaterial, std::size_t triangles, const Look& look) {
  constexpr double mostLayers = 1024;  // the renderer's limit
  double brightest = look.noBackground ? 0.0 : largest(look.backgroundColor);
  for (const auto& [name, errors] : byMaterial) brightest = std::max(brightest, errors.radiance);
  const double rounding = 8.0 * u * std::min(double(triangles), mostLayers) * brightest;
  for (auto& [name, errors] : byMaterial) errors.rounding += rounding;
}

}  // namespace glint
