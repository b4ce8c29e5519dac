#include <gtest/gtest.h>

#include <cmath>

#include "glint/gltf/scene_file.h"
#include "reference_scenes.h"
#include "scenes.h"
#include "viewer/probe.h"

namespace glint::viewer {
namespace viewer_probe_test {

// Compares every pixel's probe with the whole picture by the reference, which draws all triangles.
// If an edge passes a pixel's centre, the ray may find its neighbour, so a few pixels may differ.
// Returns how many pixels of the model were compared.
int compareAll(const Scene& scene, const DecodedImages& images, const Look& look) {
  const Bounds bounds = boundsOf(scene);
  ReferenceRenderer renderer(scene, images, bounds, look, 1);
  const Image exact = renderer.draw();
  const Picker picker(scene);
  int compared = 0, off = 0;
  for (int y = 0; y < look.resolution.y; ++y)
    for (int x = 0; x < look.resolution.x; ++x) {
      const Probe probe =
          probePixel({scene, images, bounds, picker, renderer.list()}, look, exact, &exact, {x, y});
      if (!probe.hit) continue;
      ++compared;
      // The reference's own picture is rounded to float once: half a unit of the last place. A
      // single triangle has the same values as in the mesh, but a ray's hit may lie behind an edge.
      double largest = 0;
      for (const double ulps : probe.ulps) largest = std::max(largest, std::abs(ulps));
      off += !(largest <= 0.5);
    }
  EXPECT_LE(off, compared / 500);
  return compared;
}

Scene model(const char* name) {
  return loadGltf(std::string(GLINT_SOURCE_DIR) + "/models/" + name);
}

TEST(ViewerProbe, EveryProgramHasTheReferencesValues) {
  const Scene scene = model("teapot.glb");
  for (const Shading shading : {Shading::flat, Shading::gouraud, Shading::phong,
                                Shading::blinnPhong, Shading::environment}) {
    Look look = scenes::plainLook(40, 32, shading);
    EXPECT_GT(compareAll(scene, {}, look), 200);
  }
}

TEST(ViewerProbe, SurfacesThatAreSeenThroughOneAnother) {
  Scene scene = test::sceneOf(test::sphere(12, 8));
  Material& material = scene.materials[0];
  material.alphaMode = AlphaMode::blend;
  material.alpha = 0.4;
  material.doubleSided = true;
  material.shading.specular = 0.7;
  scene.instances.push_back({0, glm::dmat4(1)});
  scene.instances.back().world[3] = {0.3, 0.1, -2.5, 1};
  Look look = scenes::plainLook(48, 48);
  EXPECT_GT(compareAll(scene, {}, look), 400);
  const Bounds bounds = boundsOf(scene);
  const Picker picker(scene);
  const DrawList list = makeDrawList(scene, bounds, look);
  const Image black{48, 48, std::vector<float>(48 * 48 * 4)};
  const Probe probe = probePixel({scene, {}, bounds, picker, list}, look, black, nullptr, {24, 24});
  EXPECT_EQ(probe.layers, 4);  // two sides of two spheres
  EXPECT_FALSE(probe.center);
  look.shading = Shading::environment;  // refracts instead of blending
  EXPECT_GT(compareAll(scene, {}, look), 400);
}

TEST(ViewerProbe, TexturedAndMaskedSurfaces) {
  Mesh quad = test::quad();
  quad.texcoords = {{{0, 0}, {2, 0}, {2, 2}, {0, 2}}};
  Scene scene = test::sceneOf(quad);
  Material& material = scene.materials[0];
  material.colorTexture = Texture{};
  material.alphaMode = AlphaMode::mask;
  scene.images.resize(1);
  DecodedImages images;
  ByteImage& image = images[0].image;
  image.width = image.height = 4;
  for (int i = 0; i < 16; ++i)
    image.values.insert(image.values.end(), {std::uint8_t(i * 16), std::uint8_t(255 - i * 9),
                                             std::uint8_t(i * i), std::uint8_t(i % 3 ? 255 : 20)});
  scene.materials[0].colorTexture->sampler.mip = MipFilter::none;
  Look look = scenes::plainLook(40, 40);
  EXPECT_GT(compareAll(scene, images, look), 300);
}

// They are probed, too, at every pixel that shows one, by material and colour.
TEST(ViewerProbe, PointsAndLines) {
  Mesh lines;
  lines.topology = Topology::lines;
  lines.positions = {{-1, -0.7f, 0}, {1, 0.5f, 0.2f}, {-0.3f, 1, 0}, {0.2f, -1, -0.4f}};
  lines.indices = {0, 1, 2, 3};
  Mesh points;
  points.topology = Topology::points;
  points.positions = {{0.6f, 0.6f, 0}, {-0.6f, 0.4f, 0.3f}, {0.1f, -0.2f, 0.9f}};
  points.indices = {0, 1, 2};
  points.material = 1;
  Scene scene = test::sceneOf(lines);
  scene.materials[0].shading.color = {0.8, 0.4, 0.1};
  scene.materials.push_back(scene.materials[0]);
  scene.materials[1].shading.color = {0.1, 0.9, 0.4};
  scene.meshes.push_back(points);
  scene.instances.push_back({1, glm::dmat4(1)});
  const Look look = scenes::plainLook(48, 40);
  const Bounds bounds = boundsOf(scene);
  ReferenceRenderer renderer(scene, {}, bounds, look, 1);
  const Image exact = renderer.draw();
  int drawn = 0;
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 48; ++x)
      drawn += std::abs(double(exact.row(y)[4 * x]) - look.backgroundColor.r) > 1e-6;
  EXPECT_GT(drawn, 40);
  EXPECT_EQ(compareAll(scene, {}, look), drawn);
  // The mouse need not be exactly on the pixel.
  const Picker picker(scene);
  const Camera camera = cameraFor(scene, bounds, look);
  int named = 0;
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 48; ++x)
      named +=
          picker.pick(scene, rayThrough(camera, {x + 0.5, y + 0.5}, {48, 40}), false).has_value();
  EXPECT_GT(named, drawn);
  EXPECT_LT(named, 4 * drawn);
}

TEST(ViewerProbe, TermsAddUp) {
  const Scene scene = model("teapot.glb");
  Look look = scenes::plainLook(64, 48, Shading::environment);
  Light spot;
  spot.type = Light::Type::spot;
  spot.position = {3, 4, 5};
  spot.direction = {-3, -4, -5};
  spot.innerAngle = 10;
  spot.outerAngle = 40;
  Light none;
  none.direction = {1, 0, 0};
  none.intensity = glm::dvec3(0.0);
  Light sun;
  sun.direction = {0, 1, 1};
  look.light = {none, spot, sun};
  const Bounds bounds = boundsOf(scene);
  const Picker picker(scene);
  const DrawList list = makeDrawList(scene, bounds, look);
  const Image black{64, 48, std::vector<float>(64 * 48 * 4)};
  const Probe p = probePixel({scene, {}, bounds, picker, list}, look, black, nullptr, {30, 26});
  ASSERT_TRUE(p.hit);
  ASSERT_EQ(p.lights.size(), 2u);  // a light of intensity 0 is not counted
  EXPECT_EQ(p.lights[0].name, "spot");
  EXPECT_EQ(p.lights[1].name, "directional");
  glm::dvec3 sum = p.ambient;
  for (const LightProbe& light : p.lights) sum += light.diffuse + light.specular;
  const glm::dvec3 all = (1 - p.transparency) * sum + p.emission + p.reflection + p.refraction;
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(all[i], p.expected[i], 1e-14);
  EXPECT_NEAR(glm::length(p.N), 1, 1e-12);
  EXPECT_NEAR(glm::length(p.lights[0].L), 1, 1e-12);
  EXPECT_NEAR(glm::dot(p.N, p.V), p.nv, 1e-12);
  EXPECT_NE(probeText(scene, p).find("\"reflection\""), std::string::npos);
}

TEST(ViewerProbe, TheBackgroundIsTheReferencesToo) {
  const Scene scene = model("sphere.glb");
  Look look = scenes::plainLook(32, 32, Shading::environment);
  const Bounds bounds = boundsOf(scene);
  for (const bool environment : {false, true}) {
    look.environmentBackground = environment;
    ReferenceRenderer renderer(scene, {}, bounds, look, 1);
    const Image exact = renderer.draw();
    const Picker picker(scene);
    const Probe p =
        probePixel({scene, {}, bounds, picker, renderer.list()}, look, exact, &exact, {1, 2});
    EXPECT_FALSE(p.hit);
    for (const double ulps : p.ulps) EXPECT_LE(std::abs(ulps), 0.5);
  }
}

}  // namespace viewer_probe_test
}  // namespace glint::viewer
