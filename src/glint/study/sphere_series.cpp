#include <cmath>
#include <memory>

#include "glint/reference/renderer.h"
#include "glint/shading/angles.h"
#include "glint/study/series.h"

// Series of spheres, whose geometry is known exactly.
namespace glint {
namespace {

/// A sphere seen along -Z without perspective, by an infinite viewer.
Look sphereLook(const SeriesTools& tools, const glm::dvec3& light) {
  Look look;
  look.resolution = glm::ivec2(std::min(tools.look.resolution.x, tools.look.resolution.y));
  look.antiAliasing = tools.look.antiAliasing;
  look.noBackground = true;
  look.cameraDirection = glm::dvec3(0, 0, -1);
  look.cameraOrthographic = true;
  look.viewer = Viewer::infinite;
  Light sun;
  sun.direction = light;
  look.light = {sun};
  look.ambientLight = glm::dvec3(0.0);
  return look;
}

ShadingParameters white(double diffuse, double specular, double exponent) {
  ShadingParameters m;
  m.ambient = 0;
  m.diffuse = diffuse;
  m.specular = specular;
  m.exponent = exponent;
  return m;
}

struct Sphere {
  StudyScene scene;
  GpuScene gpu;
  Sphere(int level, const ShadingParameters& shading, const Look& look)
      : scene(sphereScene(level, shading), look), gpu(scene.scene, scene.images) {}
};

/// The mask without pixels near the silhouette or the terminator, where facets of any fineness hide
/// or lose something, and the true sphere's radiance at its pixels.
struct TrueSphere {
  StudyMask mask;
  Radiances radiances;
};

TrueSphere trueSphere(const SeriesTools& tools, Sphere& sphere, const Look& look,
                      const glm::dvec3& light) {
  const StudyMask all = maskOf(tools.renderer, sphere.gpu, sphere.scene, look);
  const Look exact = exactLook(look, Shading::phong);
  const ReferenceRenderer reference(sphere.scene.scene, sphere.scene.images, sphere.scene.bounds,
                                    exact);
  const Camera& camera = reference.list().camera;
  const glm::dvec3 center = eyeRotation(camera) * -camera.eye;
  const double radius = 1 / camera.unit;
  const glm::dvec3 l = light / std::sqrt(glm::dot(light, light));
  TrueSphere result;
  const auto attributes = reference.attributes(0, look.resolution.y);
  for (std::size_t i = 0; i < all.pixels.size(); ++i) {
    reference::Attributes a = attributes[all.pixels[i]];
    const glm::dvec2 d = glm::dvec2(a.position - center) / radius;
    const double z = 1 - glm::dot(d, d);
    if (!(z > 0)) continue;
    const glm::dvec3 n(d, std::sqrt(z));
    if (n.z < 0.3 || glm::dot(n, l) < 0.2) continue;
    a.normal = n;
    a.position = center + radius * n;
    result.mask.pixels.push_back(all.pixels[i]);
    result.mask.inputs.push_back(all.inputs[i]);
    result.radiances.push_back(reference.shade(a).radiance);
  }
  return result;
}

/// Roughly the angle that an edge of the icosphere spans at its centre; halved at each level.
double edgeAngle(int level) { return std::acos(1 / std::sqrt(5.0)) / std::exp2(level); }

}  // namespace

std::optional<StudySeries> incidenceSeries(const SeriesTools& tools) {
  constexpr double exponent = 50;
  const StudySeries series{
      "incidence", "Blinn-Phong against Phong over the highlight's incidence",
      "incidence θ, degrees",
      "highlight alone, α = 50, on a sphere with an infinite viewer; all against exact phong",
      false};
  std::vector<double> angles{0, 10, 20, 30, 40, 45, 50, 60, 70, 75};
  if (tools.quick) angles = {0, 30, 45, 60, 75};
  SeriesDrawer drawer(tools, series);
  Sphere sphere(tools.quick ? 5 : 6, white(0, 1, exponent), tools.look);
  for (std::size_t i = 0; i < angles.size() && !tools.stopped(); ++i) {
    const double angle = angles[i] * radians;
    Look look = sphereLook(tools, {std::sin(2 * angle), 0, std::cos(2 * angle)});
    const StudyMask mask = maskOf(tools.renderer, sphere.gpu, sphere.scene, look);
    const Radiances truth = truthOf(sphere.scene, look, Shading::phong, mask);
    const auto add = [&](const std::string& name, Shading program, double factor) {
      look.blinnFactor = factor;
      drawer.add(name, angles[i], sphere.gpu, sphere.scene, exactLook(look, program), &mask,
                 &truth);
    };
    add("phong", Shading::phong, 4);
    add("blinn-phong 4α", Shading::blinnPhong, 4);
    add("blinn-phong 4α cos θ", Shading::blinnPhong, 4 * std::cos(angle));
    tools.tell(0.5 * double(i + 1) / double(angles.size()));
  }
  return drawer.finish();
}

std::optional<StudySeries> finenessSeries(const SeriesTools& tools) {
  StudySeries series{
      "fineness", "Programs over the mesh resolution", "edge / radius h",
      "diffuse 0.8, highlight 0.5 at α = 40 unless named, on spheres seen without perspective; "
      "against the true sphere per pixel, where N·L > 0.2 and N·V > 0.3"};
  series.hasOrders = true;
  SeriesDrawer drawer(tools, series);
  const glm::dvec3 light(0.35, 0.25, 1);
  const int finest = tools.quick ? 5 : 6;
  std::vector<std::unique_ptr<Sphere>> spheres;
  for (int level = 1; level <= finest && !tools.stopped(); ++level) {
    const Look look = sphereLook(tools, light);
    spheres.push_back(std::make_unique<Sphere>(level, white(0.8, 0.5, 40), look));
    Sphere& sphere = *spheres.back();
    for (const double exponent : {40.0, 10.0, 160.0}) {
      Look shiny = look;
      shiny.material[""].exponent = exponent;
      const TrueSphere truth = trueSphere(tools, sphere, shiny, light);
      const auto add = [&](const std::string& name, Shading program) {
        drawer.add(name, edgeAngle(level), sphere.gpu, sphere.scene, exactLook(shiny, program),
                   &truth.mask, &truth.radiances);
      };
      if (exponent == 40) {
        add("flat", Shading::flat);
        add("gouraud", Shading::gouraud);
        add("phong", Shading::phong);
      } else {
        add("gouraud α=" + std::to_string(int(exponent)), Shading::gouraud);
      }
    }
    tools.tell(0.5 * level / finest);
  }
  return drawer.finish();
}

}  // namespace glint
