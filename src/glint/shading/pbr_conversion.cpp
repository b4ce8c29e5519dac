#include "glint/shading/pbr_conversion.h"

#include <algorithm>
#include <cmath>

#include "glint/shading/safe.h"

namespace glint {
namespace {

constexpr double largestIor = 1e3;
constexpr double dielectricF0 = 0.04;

double interpolate(double a, double b, double t) { return a + (b - a) * t; }

}  // namespace

double exponentFromRoughness(double roughness) {
  const double r = clampTo(roughness, smallestRoughness, 1.0);
  return 0.5 / (r * r * r * r) - 0.5;
}

double roughnessFromExponent(double exponent) {
  const double alpha = clampTo(exponent, 0.0, 1e6);
  return clampTo(std::pow(2.0 / (4.0 * alpha + 2.0), 0.25), smallestRoughness, 1.0);
}

double highlightPeak(double f0, double exponent) {
  const double blinn = 4.0 * clampTo(exponent, 0.0, 1e6);
  const double x = clampTo(f0, 0.0, 1.0) * (blinn / 8.0) * (blinn / (blinn + 8.0));
  return x / (1.0 + x);
}

double dielectricReflectance(const PbrParameters& pbr) {
  const double n = pbr.ior == 0.0 ? largestIor : clampTo(pbr.ior, 1.0, largestIor);
  const double amplitude = (n - 1.0) / (n + 1.0);
  return amplitude * amplitude * clampTo(pbr.specularFactor, 0.0, 1.0);
}

ConvertedParameters convertPbr(const PbrParameters& pbr) {
  const double metallic = clampTo(pbr.metallic, 0.0, 1.0);
  ConvertedParameters out;
  out.ior = pbr.ior == 0.0 ? largestIor : clampTo(pbr.ior, 1.0, largestIor);
  out.exponent = exponentFromRoughness(pbr.roughness);
  out.metalness = metallic;
  const double f0 = dielectricReflectance(pbr);
  out.specular =
      interpolate(highlightPeak(f0, out.exponent), highlightPeak(1.0, out.exponent), metallic);
  out.diffuse = interpolate(1.0, metalDiffuse, metallic);
  out.share = interpolate(f0, 1.0, metallic);
  return out;
}

MetalShare metalShare(const SpecularGlossiness& from) {
  const auto largest = [](const glm::dvec3& v) {
    return std::max({clampTo(v.x, 0, 1), clampTo(v.y, 0, 1), clampTo(v.z, 0, 1)});
  };
  const double f0 = largest(from.specular);
  // Rises gradually from 0.04, so that the share does not jump if a file rounds that number.
  const double start = clampTo((f0 - dielectricF0) / dielectricF0, 0, 1);
  return {f0 > 0 ? start * clampTo(1 - largest(from.diffuse) / f0, 0, 1) : 0, f0};
}

std::pair<ConvertedParameters, glm::dvec3> convertSpecularGlossiness(
    const SpecularGlossiness& from) {
  const auto unit = [](const glm::dvec3& v) {
    return glm::dvec3(clampTo(v.x, 0, 1), clampTo(v.y, 0, 1), clampTo(v.z, 0, 1));
  };
  const glm::dvec3 diffuse = unit(from.diffuse), specular = unit(from.specular);
  const MetalShare share = metalShare(from);
  const double amplitude = std::sqrt(share.reflectance);
  const double ior = amplitude < 1 ? (1 + amplitude) / (1 - amplitude) : largestIor;
  return {convertPbr({share.metallic, 1 - clampTo(from.glossiness, 0, 1), ior, 1}),
          diffuse + (specular - diffuse) * share.metallic};
}

}  // namespace glint
