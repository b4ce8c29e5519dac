// GL pictures compared with the double-precision reference: scenes, each difficult in one way.

#include <gtest/gtest.h>

#include <functional>
#include <numbers>

#include "comparison.h"
#include "glint/shading/safe.h"
#include "pictures.h"
#include "reference_scenes.h"
#include "textures.h"

namespace glint::test::reference_special_gl_test {

/// A special scene and the differences allowed in its pictures.
struct Special {
  const char* name;
  std::function<void(Scene&, Look&)> make;
  bool textured = false;
};

Material paint(double specular = 0.5) {
  Material m;
  m.shading.specular = specular;
  m.shading.color = {0.8, 0.4, 0.2};
  return m;
}

// Triangles with all corners at pixel centres: samples on edges show which triangle owns them.
void cornersAtCenters(Scene& scene, Look& look) {
  std::vector<glm::vec3> corners;
  for (const glm::vec2 v : {glm::vec2(-20.5f, -12.5f),
                            {18.5f, -12.5f},
                            {-20.5f, 20.5f},
                            {-4.5f, 25.5f},
                            {9.5f, 11.5f},
                            {23.5f, 25.5f},
                            {0.5f, -20.5f},
                            {20.5f, -30.5f},
                            {20.5f, -14.5f},
                            {-30.5f, 0.5f},
                            {-24.5f, -5.5f},
                            {-24.5f, 6.5f}})
    corners.emplace_back(v, 0.0f);
  Material both = paint();
  both.doubleSided = true;
  scene = scenes::sceneOf({{scenes::triangles(corners), both}});
  look.resolution = {64, 64};
  scenes::lookAlongZ(scene, look, 32);
}

/// Waves as a normal map, and a rotated texture, on the sphere under a mirroring transform.
void normalMapped(Scene& scene, Look& look) {
  scene = shippedScene("sphere");
  const auto waves = [](int x, int y) {
    const double wave = 2 * std::numbers::pi / 32;
    const glm::dvec3 n =
        glm::normalize(glm::dvec3(0.4 * std::sin(wave * x), 0.4 * std::cos(wave * y), 1));
    return glm::ivec4(glm::round(127.5 * (n + 1.0)), 255);
  };
  const auto ramp = [](int x, int y) { return glm::ivec4(60 + x, 200 - y, 128, 255); };
  scene.images.push_back({"waves", png(64, 64, waves), true});
  scene.images.push_back({"ramp", png(64, 64, ramp), false});
  Texture normal, color;
  normal.sampler.mip = color.sampler.mip = MipFilter::none;
  normal.transform = {glm::dvec2(3, 0), glm::dvec2(0, 2), glm::dvec2(0.1, 0.2)};
  color.image = 1;
  color.sampler.wrapS = color.sampler.wrapT = Wrap::mirroredRepeat;
  color.transform = {glm::dvec2(0.8, -0.6), glm::dvec2(0.6, 0.8), glm::dvec2(0.3, 0)};
  for (Material& m : scene.materials) {
    m.normalTexture = normal;
    m.normalScale = 1.3;
    m.colorTexture = color;
    m.doubleSided = true;
  }
  for (Mesh& mesh : scene.meshes) {
    mesh.texcoords.resize(1);
    mesh.texcoords[0].clear();
    mesh.tangents.clear();
    for (const glm::vec3& p : mesh.positions) {  // from longitude and latitude
      const double turn = std::atan2(double(p.x), double(p.z)) / (2 * std::numbers::pi);
      mesh.texcoords[0].emplace_back(turn, 0.5 - 0.5 * double(p.y));
      mesh.tangents.emplace_back(glm::vec3(safeNormalize(glm::dvec3(double(p.z), 0, -double(p.x)))),
                                 1.0f);
    }
  }
  scene.instances[0].world = glm::dmat4(-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1);
  look.cameraDirection = glm::dvec3(0.2, -0.1, -1);  // away from the seam, where u jumps
}

const Special specials[] = {
    {"normal map, mirrored, textures turned", normalMapped, true},
    {"corners at pixel centres", cornersAtCenters},
    {"floor through the eye",
     [](Scene& scene, Look& look) {
       Mesh mesh = scenes::triangles({{-100, -1, 50}, {100, -1, 50}, {0, -1, -100}});
       mesh.normals.assign(3, glm::vec3(0, 1, 0));
       scene = scenes::sceneOf({{mesh, paint()}});
       scenes::lookFromOrigin(scene, look, 1, 0.5, 40);
     }},
    {"all kinds of lights",
     [](Scene& scene, Look& look) {
       scene = shippedScene("torus");
       Light sun, lamp, spot, camera;
       sun.direction = {1, 1, 0.3};
       sun.intensity = {0.5, 0.2, 0.1};
       lamp.type = Light::Type::point;
       lamp.position = {1, 1.2, 1.5};
       spot.type = Light::Type::spot;
       spot.position = {0, 2, 2};
       spot.direction = {0, -1, -0.9};
       spot.innerAngle = 5;
       spot.outerAngle = 30;
       spot.intensity = {0.1, 1, 0.3};
       camera.type = Light::Type::camera;
       camera.direction = {0.2, 0.1, 1};
       camera.intensity = glm::dvec3(0.3);
       look.light = std::vector{sun, lamp, spot, camera};
     }},
    {"lamps of the file",
     [](Scene& scene, Look&) {
       scene = shippedScene("torus");
       FileLight sun, lamp, spot;
       sun.direction = glm::normalize(glm::dvec3(-1, -1, -0.3));
       sun.intensity = glm::dvec3(2, 1, 1);
       lamp.type = FileLight::Type::point;
       lamp.position = {1, 0.6, 1};
       lamp.range = 1.5;
       lamp.intensity = glm::dvec3(4, 2, 6);
       spot.type = FileLight::Type::spot;
       spot.position = {0, 1.5, 1};
       spot.direction = glm::normalize(glm::dvec3(0, -1, -0.4));
       spot.innerAngle = 0.2;
       spot.outerAngle = 0.6;
       spot.intensity = glm::dvec3(1, 8, 3);
       scene.lights = {sun, lamp, spot};
       scene.lightScale = 0.2;
     }},
    {"a picture around it, seen through glass",
     [](Scene& scene, Look& look) {
       scene = shippedScene("sphere");
       for (Material& m : scene.materials) m.shading.transmission = 0.6;
       look.hdriFile = environmentPicture("smooth", 128, [](const glm::dvec3& d) {
         const glm::dvec3 next(d.y, d.z, d.x);
         return 0.5 + 0.4 * glm::sin(3.0 * d + next);
       });
       look.environmentRotation = 35;
     }},
    {"orthographic",
     [](Scene& scene, Look& look) {
       scene = shippedScene("teapot");
       look.cameraOrthographic = true;
     }},
    {"infinite viewer, pow",
     [](Scene& scene, Look& look) {
       scene = shippedScene("sphere");
       look.viewer = Viewer::infinite;
       look.highlight = Highlight::pow;
     }},
    {"uneven scale, mirrored",
     [](Scene& scene, Look& look) {
       scene = shippedScene("torus");
       scene.instances[0].world =
           glm::dmat4(-1, 0.2, 0, 0, 0, 2, 0.1, 0, 0.3, 0, 0.5, 0, 3, -2, 1, 1);
       look.resolution = {150, 90};
     }},
    {"a million away",
     [](Scene& scene, Look& look) {
       scene = shippedScene("torus");
       scene.instances[0].world[3] = glm::dvec4(1e6, -2e6, 5e5, 1);
       look.resolution = {100, 100};
     }},
    {"1e-12 in size",
     [](Scene& scene, Look& look) {
       scene = shippedScene("torus");
       scene.instances[0].world = glm::dmat4(1e-12);
       scene.instances[0].world[3].w = 1;
       look.resolution = {100, 100};
     }},
    {"glass, both sides, schlick",
     [](Scene& scene, Look& look) {
       scene = shippedScene("torus");
       for (Material& m : scene.materials) m.shading.transmission = 0.6;
       look.twoSided = true;
       look.fresnel = Fresnel::schlick;
       look.cameraPosition = glm::dvec3(0.6, 0.1, 0);  // inside
     }},
    {"textbook in water",
     [](Scene& scene, Look& look) {
       scene = shippedScene("teapot");
       look.fresnel = Fresnel::textbook;
       look.mediumIor = 1.33;
       look.environment = Environment::sky;
     }},
    {"blended panes that cross",
     [](Scene& scene, Look& look) {
       Material glass = paint();
       glass.alphaMode = AlphaMode::blend;
       glass.alpha = 0.4;
       glass.doubleSided = true;
       // One mesh, nearest first, whose triangles intersect each other.
       Mesh mesh = scenes::triangles({{-24, -20, 6},
                                      {24, -20, -6},
                                      {0, 24, 0},
                                      {-24, -18, -6},
                                      {24, -22, 6},
                                      {2, 22, 1},
                                      {-20, -24, 0},
                                      {22, -10, 3},
                                      {-4, 24, -4}});
       scene = scenes::sceneOf({{mesh, glass}});
       look.resolution = {64, 64};
       scenes::lookAlongZ(scene, look, 32);
     }},
    {"blended, both sides",
     [](Scene& scene, Look&) {
       scene = shippedScene("torus");
       for (Material& m : scene.materials) {
         m.alphaMode = AlphaMode::blend;
         m.alpha = 0.6;
         m.doubleSided = true;
       }
     }},
};

TEST_P(AgainstReference, SpecialScenes) {
  Renderer& renderer = stage().renderer();
  printHeading();
  for (const Special& special : specials)
    for (Shading shading : allPrograms) {
      // Flat and Gouraud shading ignore normal maps, which the driver's normals would include.
      if (special.textured && !perPixel(shading)) continue;
      Look look = lookWith(shading, 200);
      Scene scene;
      special.make(scene, look);
      Model model = modelOf(std::move(scene), look);
      Comparison c = compare(renderer, model, look);
      if (c.blended) {
        const Layers layers = layersOf(renderer, model, look);
        c = compare(renderer, model, look, layers.nearEdge);
        c.interpolation = layers.interpolation;
      }
      print(special.name, shading, c, wholeBound(c));
      expectAccurate(special.name, look, c);
      EXPECT_LE(c.filtering, 1e-6) << special.name;
    }
}

}  // namespace glint::test::reference_special_gl_test
