#include "probe.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>

#include "formulas.h"
#include "glint/image/srgb.h"
#include "glint/render/variant.h"
#include "glint/scene/lights.h"
#include "glint/scene/look_text.h"
#include "glint/scene/parameters.h"
#include "glint/shading/sum.h"

namespace glint {
namespace {

constexpr double radians = std::numbers::pi / 180;

std::string saved(const Look& look, std::string_view name) {
  for (const Parameter& p : lookParameters())
    if (p.name == name) return p.save(look).get<std::string>();
  return {};
}

/// Light that reaches a point: the direction to it and its intensity there.
struct Arriving {
  glm::dvec3 L{0.0}, intensity{0.0};
};

double falloff(const Light& light, const glm::dvec3& point) {
  return light.fallsOff ? distanceFalloff(glm::length(light.position - point), light.range) : 1.0;
}

Arriving arriving(const Light& light, const glm::dvec3& point, const Camera& camera) {
  const auto unit = [](const glm::dvec3& v) { return v / glm::length(v); };
  switch (light.type) {
    case Light::Type::directional:
      return {unit(light.direction), light.intensity};
    case Light::Type::camera:
      return {camera.axes * unit(light.direction), light.intensity};
    case Light::Type::point:
      return {unit(light.position - point), light.intensity * falloff(light, point)};
    case Light::Type::spot: {
      const glm::dvec3 L = unit(light.position - point);
      const double c = glm::dot(-L, unit(light.direction));
      const double outer = std::cos(light.outerAngle * radians);
      const double inner = std::cos(light.innerAngle * radians);
      const double share = std::clamp((c - outer) / (inner - outer), 0.0, 1.0);
      return {L, light.intensity * (share * share * falloff(light, point))};
    }
  }
  return {};
}

/// A point where the sum is formed.
struct Point {
  glm::dvec3 position, N;
};

}  // namespace

Probe probePixel(const Scene& scene, const Bounds& bounds, const Picker& picker, const Look& look,
                 const Image& linear, glm::ivec2 pixel) {
  Probe probe;
  probe.pixel = pixel;
  const float* rgba = linear.row(pixel.y) + std::size_t(4) * std::size_t(pixel.x);
  const float scale = float(std::exp2(look.exposure));
  for (int i = 0; i < 3; ++i) {
    probe.shown[i] = rgba[i];
    probe.code[i] = encodeSrgb8(rgba[i] * scale);
  }
  const Camera camera = cameraFor(scene, bounds, look);
  const Ray ray = rayThrough(camera, glm::dvec2(pixel) + 0.5, look.resolution);
  probe.hit = picker.pick(scene, ray, look.twoSided);
  if (!probe.hit) {
    probe.remark = "background";
    return probe;
  }
  const Hit& hit = *probe.hit;
  const Mesh& mesh = scene.meshes[std::size_t(hit.mesh)];
  const Instance& instance = scene.instances[std::size_t(hit.instance)];
  const Material material = editedMaterial(scene.materials[std::size_t(hit.material)], look);
  const ShadingParameters& s = material.shading;
  const Variant variant = variantFor(mesh, material, instance.world,
                                     withFileLights(scene, look), camera.orthographic);

  const auto viewFrom = [&](const glm::dvec3& point) {
    if (camera.orthographic || look.viewer == Viewer::infinite) return camera.axes[2];
    return glm::normalize(camera.eye - point);
  };
  const auto corner = [&](int i) {
    const std::uint32_t index = mesh.indices[3 * hit.triangle + std::size_t(i)];
    const glm::dmat3 toWorld(instance.world);
    const glm::dmat3 normals = glm::transpose(glm::inverse(toWorld));
    return Point{
        toWorld * (mesh.origin + glm::dvec3(mesh.positions[index])) + glm::dvec3(instance.world[3]),
        glm::normalize(normals * glm::dvec3(mesh.normals[index]))};
  };
  Point points[3] = {corner(0), corner(1), corner(2)};
  glm::dvec3 weights = hit.barycentric;
  Point shaded{hit.position, hit.normal};
  if (look.shading == Shading::flat) {
    const glm::dvec3 across = glm::cross(points[1].position - points[0].position,
                                         points[2].position - points[0].position);
    shaded.N = glm::normalize(across);
    if (glm::determinant(glm::dmat3(instance.world)) < 0) shaded.N = -shaded.N;
    shaded.position = (points[0].position + points[1].position + points[2].position) / 3.0;
  }
  const bool gouraud = look.shading == Shading::gouraud;
  const int count = gouraud ? 3 : 1;
  if (!gouraud) {
    points[0] = shaded;
    weights = {1, 0, 0};
  }
  if (hit.backFace) {
    shaded.N = -shaded.N;
    for (Point& p : points) p.N = -p.N;
  }
  probe.N = shaded.N;
  probe.V = viewFrom(shaded.position);
  probe.nv = glm::dot(probe.N, probe.V);

  SumInput input;
  input.ambient = s.ambient;
  input.diffuse = s.diffuse;
  input.specular = s.specular;
  input.exponent = s.exponent;
  input.blinnFactor = look.blinnFactor;
  input.blinn = look.shading == Shading::blinnPhong || look.shading == Shading::environment;
  input.highlight = saved(look, "highlight");
  const double n1 = hit.backFace ? s.ior : look.mediumIor;
  const double n2 = hit.backFace ? look.mediumIor : s.ior;
  probe.reflectance = fresnelValue("exact", probe.nv, n1, n2, look.schlickExponent);

  const glm::dvec3 C = s.color;
  const glm::dvec3 S = s.metalness * C + (1 - s.metalness) * glm::dvec3(1.0);
  probe.ambient = s.ambient * C * look.ambientLight;
  probe.emission = material.emission;
  glm::dvec3 sum = probe.ambient + probe.emission;
  for (const Light& light : lightsOf(withFileLights(scene, look))) {
    LightProbe each;
    const std::string text = lightText(light);
    each.name = text.substr(0, text.find(':'));
    for (int i = 0; i < count; ++i) {
      const Arriving from = arriving(light, points[i].position, camera);
      const SumValue value =
          lightValue(input, points[i].N, from.L, viewFrom(points[i].position), from.intensity);
      each.diffuse += weights[i] * C * value.matte;
      each.specular += weights[i] * S * value.specular;
    }
    const Arriving from = arriving(light, shaded.position, camera);
    each.L = from.L;
    each.nl = glm::dot(probe.N, from.L);
    each.rv = glm::dot(2 * each.nl * probe.N - from.L, probe.V);
    const glm::dvec3 half = from.L + probe.V;
    each.nh = glm::length(half) > 0 ? glm::dot(probe.N, glm::normalize(half)) : 0;
    sum += each.diffuse + each.specular;
    probe.lights.push_back(each);
  }
  if (variant.unlit) {
    probe.remark = "unlit: shows its colour";
    return probe;
  }
  if (variant.colorTexture || variant.vertexColors || variant.emissionTexture) {
    probe.remark = "textured: the terms are those of the material's own colour";
    return probe;
  }
  if (look.shading == Shading::environment || variant.alphaBlend) {
    probe.remark = look.shading == Shading::environment
                       ? "the terms are those of the sum; what is reflected and refracted comes on "
                         "top"
                       : "blended: what lies behind shows through";
    return probe;
  }
  probe.computed = true;
  probe.expected = sum;
  for (int i = 0; i < 3; ++i) {
    const float e = float(sum[i]);
    const double unit = double(std::nextafter(std::abs(e), INFINITY)) - double(std::abs(e));
    probe.ulps[i] = (double(probe.shown[i]) - sum[i]) / unit;
    probe.expectedCode[i] = encodeSrgb8(e * scale);
  }
  if (look.antiAliasing.mode != AntiAliasing::Mode::none)
    probe.remark =
        "anti-aliased: the driver shades at another place within the pixel than its centre, and an "
        "edge is "
        "a mean; without anti-aliasing the two agree to a few ulp";
  return probe;
}

}  // namespace glint
