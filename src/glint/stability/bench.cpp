#include "glint/stability/bench.h"

#include <algorithm>

#include "glint/image/error.h"
#include "glint/reference/renderer.h"
#include "glint/scene/look_text.h"
#include "glint/shading/safe.h"
#include "glint/stability/scenes.h"

namespace glint::stability {
Bench::Bench(const Look& forms, GlslSources sources, SetParameter set)
    : setParameter_(set),
      forms_(forms),
      sources_(std::move(sources)),
      functions_(sources_,
                 ProbeText{{"vector.glsl", "lobe.glsl", "fresnel.glsl"}, {{"DENSER_SIDE", 1}}, {}}),
      programs_(sources_),
      renderer_(sources_) {
  lobeIsExact_ = forms.highlight == HighlightForms(Highlight::exact) ||
                 forms.highlight == HighlightForms(Highlight::pow);
  fresnelIsExact_ = forms.fresnel == Fresnel::exact || forms.fresnel == Fresnel::textbook;
}

Look Bench::look(Shading shading) const {
  Look look;
  look.highlight = forms_.highlight;
  look.fresnel = forms_.fresnel;
  look.schlickExponent = forms_.schlickExponent;
  look.shading = shading;
  look.ambientLight = glm::dvec3(0);
  look.backgroundColor = glm::dvec3(0);
  look.antiAliasing = {AntiAliasing::Mode::none, 1};
  look.resolution = {8, 8};
  look.environment = Environment::white;
  return look;
}

Look Bench::lit(Shading shading, const glm::dvec3& toLight) const {
  Look lit = look(shading);
  lit.light = {directional(toLight)};
  return lit;
}

std::vector<float> Bench::run(std::string_view function,
                              const std::vector<std::vector<float>>& columns) {
  return functions_.run(function, {columns.begin(), columns.end()});
}

glm::dvec3 Bench::runVector(std::string_view function,
                            const std::vector<std::vector<float>>& columns) {
  const std::vector<float> got = run(function, columns);
  return {got[0], got[1], got[2]};
}

Image Bench::draw(const Scene& scene, const Look& look, const DecodedImages& images) {
  GpuScene gpu(scene, images);
  return renderer_.draw(gpu, boundsOf(scene), look);
}

Image Bench::draw(const Scene& scene, const Look& look, DrawList list) {
  GpuScene gpu(scene, {});
  return renderer_.draw(gpu, std::move(list), look);
}

Image Bench::reference(const Scene& scene, const Look& look, const DecodedImages& images) {
  return ReferenceRenderer(scene, images, boundsOf(scene), look, 1).draw();
}

Material litMaterial(double diffuse, double specular, double exponent) {
  Material material;
  material.shading = {0, diffuse, specular, exponent, 0, 1.0, glm::dvec3(1, 0, 0)};
  return material;
}

Geometry besidePeak(const glm::dvec3& n, const glm::dvec3& light, const glm::dvec3& side, double c,
                    bool blinn) {
  glm::dvec3 l = glm::dot(n, light) > 0 ? light : -light;
  if (glm::dot(n, l) < 0.3) l = safeNormalize(l + n);
  const glm::dvec3 axis = blinn ? n : 2 * glm::dot(n, l) * n - l;
  const glm::dvec3 at = c * axis + std::sqrt(1 - c * c) * safeNormalize(glm::cross(axis, side));
  const glm::dvec3 v = blinn ? 2 * glm::dot(at, l) * at - l : at;
  return {glm::vec3(n), glm::vec3(l), glm::vec3(-v)};
}

Look whiteRoom(const Bench& bench, double mediumIor, bool twoSided) {
  Look look = bench.look(Shading::environment);
  look.noLights = true;
  look.mediumIor = mediumIor;
  look.twoSided = twoSided;
  return look;
}

Material boundary(double ior, double transmission, double metalness, const glm::dvec3& color) {
  Material material;
  material.shading = {0, 0, 0, 1, metalness, ior, color};
  material.shading.transmission = transmission;
  return material;
}

LightTolerances tolerancesFor(double exponent) {
  // The half vector is off by the error of L + V divided by its length; Blinn's exponent is 4
  // alpha.
  return {diffuseTolerance, lobeTolerance(exponent), 2 * lobeTolerance(4 * exponent)};
}

void expectLight(Bench& bench, Record& record, const std::string& what, double exponent,
                 const std::vector<Geometry>& geometries, const std::vector<LightValues>& expected,
                 const LightTolerances& tolerances, Light::Type type) {
  const Points points = pointsOf(geometries);
  Light light;
  light.type = type;
  light.direction = {0, 0, 1};
  for (Shading shading : everyShading) {
    Look look = bench.look(shading);
    look.light = {light};
    const PointScene scene(look, litMaterial(1, 1, exponent));
    const std::vector<glm::vec3> got = bench.programs().shade(scene, points);
    const std::vector<glm::dvec3> truth = referenceShade(scene, points);
    const double tolerance = isBlinn(shading) ? tolerances.blinn : tolerances.phong;
    Worst diffuse, specular, reference;
    for (std::size_t i = 0; i < geometries.size(); ++i) {
      const std::string where = "N " + vectorText(geometries[i].n) + " L " +
                                vectorText(geometries[i].l) + " P " + vectorText(geometries[i].p);
      const double lobe = isBlinn(shading) ? expected[i].blinn : expected[i].phong;
      // Red includes the highlight, whose rounding counts against the diffuse part.
      diffuse.add(double(got[i].x) - got[i].y, expected[i].diffuse,
                  tolerances.diffuse + 2 * rounding * lobe, where);
      specular.add(got[i].y, bench.lobeIsExact() ? lobe : truth[i].y, tolerance, where);
      // Both get the same floats, most of them rounded from the values of the case.
      reference.add(truth[i].x - truth[i].y, expected[i].diffuse, tolerances.diffuse, where);
      if (bench.lobeIsExact()) reference.add(truth[i].y, lobe, tolerance, where);
    }
    const std::string name(shadingName(shading));
    diffuse.into(record, name + ": diffuse, " + what);
    specular.into(record, name + ": highlight, " + what);
    reference.into(record, name + " in the reference: " + what);
  }
}

LightValues formulaValues(const glm::dvec3& n, const glm::dvec3& l, const glm::dvec3& v,
                          double exponent) {
  using Wide = long double;
  const auto dot = [](const glm::dvec3& a, const glm::dvec3& b) {
    return Wide(a.x) * b.x + Wide(a.y) * b.y + Wide(a.z) * b.z;
  };
  const Wide nl = dot(n, l);
  if (!(nl > 0)) return {};
  const auto lobe = [](Wide cosine, Wide alpha) {
    return double(cosine > 0 ? std::pow(std::min(cosine, Wide(1)), alpha) : Wide(0));
  };
  LightValues values;
  values.diffuse = double(nl);
  values.phong = lobe(2 * nl * dot(n, v) - dot(l, v), Wide(exponent));
  const Wide square = dot(l, l) + 2 * dot(l, v) + dot(v, v);
  if (square > 1e-12L)
    values.blinn = lobe((nl + dot(n, v)) / std::sqrt(square), 4 * Wide(exponent));
  return values;
}

void takeMaterial(const std::string& text) {
  Look look;
  parseMaterialEdit(look, text);
}

std::string vectorText(const glm::dvec3& v) {
  return "(" + numberText(v.x) + ", " + numberText(v.y) + ", " + numberText(v.z) + ")";
}

}  // namespace glint::stability
