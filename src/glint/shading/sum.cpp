#include "glint/shading/sum.h"

#include <algorithm>
#include <cmath>

#include "glint/shading/safe.h"

namespace glint {
namespace {

double validFactor(double x) { return clampTo(x, 0.0, 1e6); }

glm::dvec3 validIntensity(const glm::dvec3& v) {
  return {clampTo(v.x, 0.0, 1e30), clampTo(v.y, 0.0, 1e30), clampTo(v.z, 0.0, 1e30)};
}

/// Both terms of one light. `lambda` is called only if the light is in front of the surface, so
/// that no half vector is formed where none may exist.
template <class Lambda>
LightTerms light(const SumParameters& p, const glm::dvec3& N, const glm::dvec3& L,
                 const glm::dvec3& V, const glm::dvec3& intensity, bool blinn, double alpha,
                 Lambda lambda) {
  const double NoL = glm::dot(N, L);
  if (!(NoL > 0.0)) return {};
  const glm::dvec3 I = validIntensity(intensity);
  LightTerms terms;
  terms.matte = validFactor(p.diffuse) * std::min(NoL, 1.0) * I;
  if (glm::dot(V, V) > 0.0) {
    const double strength =
        validFactor(p.specular) * lobeNormalization(p.normalization, blinn, alpha);
    terms.specular = strength * lobe(p.highlight, p.gamma, lambda(N, L, V), alpha) * I;
  }
  return terms;
}

}  // namespace

LightTerms ambientLight(const SumParameters& p, const glm::dvec3& light) {
  return {validFactor(p.ambient) * validIntensity(light), glm::dvec3(0.0)};
}

LightTerms phongLight(const SumParameters& p, const glm::dvec3& N, const glm::dvec3& L,
                      const glm::dvec3& V, const glm::dvec3& intensity) {
  return light(p, N, L, V, intensity, false, validFactor(p.exponent), phongLambda);
}

LightTerms blinnPhongLight(const SumParameters& p, const glm::dvec3& N, const glm::dvec3& L,
                           const glm::dvec3& V, const glm::dvec3& intensity) {
  const double alpha = validFactor(p.blinnFactor) * validFactor(p.exponent);
  return light(p, N, L, V, intensity, true, alpha, blinnLambda);
}

glm::dvec3 specularColor(const glm::dvec3& color, double metalness) {
  const double m = clampTo(metalness, 0.0, 1.0);
  return m * color + glm::dvec3(1.0 - m);
}

glm::dvec3 sumColor(const LightTerms& terms, const glm::dvec3& color, double metalness) {
  return color * terms.matte + specularColor(color, metalness) * terms.specular;
}

double spotFalloff(double cosAngle, double cosInner, double cosOuter) {
  if (!(cosInner > cosOuter)) return cosAngle > cosOuter ? 1.0 : 0.0;
  const double t = clampTo((cosAngle - cosOuter) / (cosInner - cosOuter), 0.0, 1.0);
  return t * t;
}

double distanceFalloff(double distance, double range) {
  const double d = clampTo(distance, 1e-6, 1e150);
  const double ratio = range > 0.0 ? d / range : 0.0;
  const double window = clampTo(1.0 - ratio * ratio * ratio * ratio, 0.0, 1.0);
  return window / (d * d);
}

}  // namespace glint
