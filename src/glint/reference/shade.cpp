#include "glint/reference/shade.h"

#include <algorithm>
#include <array>

#include "glint/shading/safe.h"
#include "glint/shading/sum.h"

namespace glint::reference {
namespace {

double dielectricReflectance(const Surface& surface, const FresnelConstants& boundary,
                             bool entering, double cosine) {
  const double outer = surface.mediumIor, inner = surface.ior;
  return reflectance(surface.fresnel, cosine,
                     {entering ? outer : inner, entering ? inner : outer, boundary,
                      surface.schlickExponent, surface.rationalSlope});
}

void addEnvironment(const Frame& frame, const Surface& surface, const Attributes& a,
                    const glm::dvec3& N, Terms& terms) {
  const glm::dvec3 V = toViewer(frame, a.position), C(a.base);
  const double cosine = glm::dot(N, V);
  const bool entering = a.front || !surface.twoSided;
  const FresnelConstants& boundary = entering ? surface.sides.entering : surface.sides.leaving;
  const double m = a.numbers.metalness;
  glm::dvec3 F(0.0);
  if (m < 1) F += (1 - m) * dielectricReflectance(surface, boundary, entering, cosine);
  if (m > 0) F += m * metalReflectance(cosine, C);
  // An environment picture is averaged over the angle by which the direction turns from pixel to
  // pixel, the largest in the square.
  const auto spread = [&](const auto& directionAt) {
    std::array<glm::dvec3, 4> d;
    for (std::size_t i = 0; i < 4; ++i) {
      Attributes at = a;
      at.position = a.square[i].position;
      at.normal = a.square[i].normal;
      d[i] = directionAt(at);
    }
    return std::max({glm::length(d[1] - d[0]), glm::length(d[2] - d[0]), glm::length(d[3] - d[1]),
                     glm::length(d[3] - d[2])});
  };
  const auto mirrored = [&](const Attributes& at) {
    return safeNormalize(reflect(-toViewer(frame, at.position), shadingNormal(surface, at)));
  };
  terms.reflection = F * environmentToward(frame, mirrored(a), frame.image ? spread(mirrored) : 0);
  terms.transparency = a.numbers.transmission;
  if (terms.transparency == 0) return;
  const double n1 = entering ? surface.mediumIor : surface.ior;
  const double n2 = entering ? surface.ior : surface.mediumIor;
  // Where a neighbour reflects totally, its refracted ray is taken to run along the surface, its
  // limit at the critical angle.
  const auto refracted = [&](const Attributes& at) {
    const glm::dvec3 v = toViewer(frame, at.position), n = shadingNormal(surface, at);
    if (const auto direction = refract(-v, n, n1, n2)) return safeNormalize(*direction);
    return safeNormalize(glm::dot(n, v) * n - v);
  };
  if (const auto direction = refract(-V, N, n1, n2))
    terms.refraction = terms.transparency * (1.0 - F) * C *
                       environmentToward(frame, *direction, frame.image ? spread(refracted) : 0);
}

}  // namespace

glm::dvec3 environmentToward(const Frame& frame, const glm::dvec3& direction, double spread) {
  const glm::dvec3 world = frame.environmentFromEye * direction;
  return frame.image ? frame.image->radiance(world, spread)
                     : environmentRadiance(frame.environment, world);
}

glm::dvec3 toViewer(const Frame& frame, const glm::dvec3& position) {
  const glm::dvec3 V = frame.constantView ? glm::dvec3(0, 0, 1) : safeNormalize(-position);
  return V == glm::dvec3(0.0) ? glm::dvec3(0, 0, 1) : V;
}

Terms lightAt(const Frame& frame, const Surface& surface, const Numbers& numbers,
              const glm::dvec3& position, const glm::dvec3& normal) {
  SumParameters p;
  p.ambient = numbers.ambient;
  p.diffuse = numbers.diffuse;
  p.specular = numbers.specular;
  p.exponent = numbers.exponent;
  p.blinnFactor = surface.blinnFactor;
  p.normalization = surface.normalization;
  const glm::dvec3 V = toViewer(frame, position);
  const auto oneLight = usesBlinn(surface.program) ? blinnPhongLight : phongLight;
  LightTerms sum = ambientLight(p, frame.ambientLight);
  for (const Light& light : frame.lights) {
    for (const Surface::Lobe& lobe : surface.lobes)
      if (light.rank >= lobe.from) p.highlight = lobe.form, p.gamma = lobe.gamma;
    if (light.type == Light::Type::directional) {
      sum += oneLight(p, normal, light.place, V, light.intensity);
      continue;
    }
    const glm::dvec3 L = safeNormalize(light.place - position);
    double share = 1;
    if (light.type == Light::Type::spot)
      share = spotFalloff(glm::dot(-L, light.axis), light.cosInner, light.cosOuter);
    if (light.fallsOff) share *= distanceFalloff(glm::length(light.place - position), light.range);
    if (share > 0) sum += oneLight(p, normal, L, V, share * light.intensity);
  }
  Terms terms;
  terms.matte = sum.matte;
  terms.specular = sum.specular;
  return terms;
}

glm::dvec3 shadingNormal(const Surface& surface, const Attributes& a) {
  const glm::dvec3 N = glm::dot(a.normal, a.normal) > 1e-6 ? safeNormalize(a.normal) : a.faceNormal;
  return surface.twoSided && !a.front ? -N : N;
}

namespace {

// |dN/dx|^2 + |dN/dy|^2, from the square's largest turns in x and in y.
double normalTurn(const Surface& surface, const Attributes& a) {
  std::array<glm::dvec3, 4> n;
  for (std::size_t i = 0; i < 4; ++i) {
    Attributes at = a;
    at.normal = a.square[i].normal;
    n[i] = shadingNormal(surface, at);
  }
  const auto apart = [&](std::size_t i, std::size_t j) {
    const glm::dvec3 d = n[i] - n[j];
    return glm::dot(d, d);
  };
  return std::max(apart(0, 1), apart(2, 3)) + std::max(apart(0, 2), apart(1, 3));
}

// The numbers with which the pixel is lit: those of the surface, with the highlight filtered.
Numbers pixelNumbers(const Surface& surface, const Attributes& a) {
  Numbers numbers = a.numbers;
  if (surface.filter == SpecularAntialiasing::none) return numbers;
  // The exponent of the lobe as drawn, which may be a multiple of the material's.
  const bool blinn = usesBlinn(surface.program);
  const double factor = blinn ? surface.blinnFactor : 1;
  const double exponent = factor * numbers.exponent;
  const FilteredLobe filtered = surface.filter == SpecularAntialiasing::toksvig
                                    ? toksvigLobe(exponent, blinn, a.normalWidth * a.normalWidth)
                                    : filteredLobe(exponent, blinn, normalTurn(surface, a));
  // The normalisation stays that of the surface: only its light is filtered.
  numbers.specular *= filtered.scale * lobeNormalization(surface.normalization, blinn, exponent) /
                      lobeNormalization(surface.normalization, blinn, filtered.exponent);
  if (factor > 0) numbers.exponent = filtered.exponent / factor;
  return numbers;
}

}  // namespace

Terms shade(const Frame& frame, const Surface& surface, const Attributes& a) {
  Terms terms;
  const glm::dvec3 C(a.base);
  if (surface.unlit) {
    terms.radiance = C + a.emission;
    return terms;
  }
  const bool carried = !isPerPixel(surface.program);
  const glm::dvec3 N = carried ? glm::dvec3(0.0) : shadingNormal(surface, a);
  if (carried) {
    terms.matte = a.matte;
    terms.specular = a.specular;
  } else {
    terms = lightAt(frame, surface, pixelNumbers(surface, a), a.position, N);
  }
  terms.sum = sumColor({terms.matte, terms.specular}, C, a.numbers.metalness);
  if (surface.program == Shading::environment) addEnvironment(frame, surface, a, N, terms);
  const glm::dvec3 sum = (1 - terms.transparency) * terms.sum;
  switch (surface.part) {
    case Part::all:
      terms.radiance = sum + terms.reflection + terms.refraction + a.emission;
      break;
    case Part::sum:
      terms.radiance = sum + a.emission;
      break;
    case Part::reflection:
      terms.radiance = terms.reflection;
      break;
    case Part::refraction:
      terms.radiance = terms.refraction;
      break;
  }
  return terms;
}

}  // namespace glint::reference
