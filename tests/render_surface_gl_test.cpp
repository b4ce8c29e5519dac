// How surfaces are drawn: alpha, sides, emission, colours, points and lines, interpolation.

#include <gmock/gmock.h>

#include <algorithm>
#include <vector>

#include "formulas.h"
#include "glint/image/srgb.h"
#include "glint/reference/renderer.h"
#include "glint/scene/look_text.h"
#include "stage.h"
#include "variants.h"

namespace glint::test::render_surface_gl_test {

class Surface : public OnStage {};

// A square over the whole picture with values at its left and right edges.
Mesh ramp(const glm::vec4& left, const glm::vec4& right) {
  Mesh mesh = quad({0, 0, 1}, 1);
  mesh.colors = {left, right, right, left};
  return mesh;
}

// The same with normals.
Mesh bent(const glm::dvec3& left, const glm::dvec3& right) {
  Mesh mesh = quad({0, 0, 1}, 1);
  const glm::vec3 a(unit(left)), b(unit(right));
  mesh.normals = {a, b, b, a};
  return mesh;
}

Material unlitMaterial(const glm::dvec3& color = glm::dvec3(1)) {
  Material m = materialOf(1, 1, 1, 1, 0, color);
  m.unlit = true;
  return m;
}

std::array<int, 3> codes(const glm::dvec3& c) {
  return {glint::encodeSrgb8(float(c.x)), glint::encodeSrgb8(float(c.y)),
          glint::encodeSrgb8(float(c.z))};
}

// Interpolation over a square of the picture's size: a plane equation with values of at most
// `size`, evaluated with some 8 roundings.
double interpolationTolerance(double size) { return 8 * size * rounding; }

TEST_P(Surface, MaskCutsAtTheCutoff) {
  for (Shading shading : everyShading)
    for (bool unlit : {false, true}) {
      Material m = materialOf(1, 1, 0, 1);
      m.alphaMode = glint::AlphaMode::mask;
      m.alphaCutoff = 0.3;
      m.alpha = 0.5;  // times the vertex colours' alpha, 0 to 1 from left to right: cut at 0.6
      m.unlit = unlit;
      Look look = parallelLook({0, 0, 1}, 20);
      look.shading = shading;
      look.ambientLight = glm::dvec3(0.5);
      const Image image = draw(sceneOf(ramp({1, 1, 1, 0}, {1, 1, 1, 1}), m), look);
      for (int x = 0; x < 20; ++x) {
        const bool there = color(image, x, 7) != glm::dvec3(0);
        EXPECT_EQ(there, (x + 0.5) / 20 > 0.6) << x << " " << glint::shadingName(shading);
        EXPECT_EQ(pixel(image, x, 7).w, 1);  // a mask leaves no transparency
      }
    }
}

// Three panes of glass in front of a wall: blended from back to front, in any order in the scene.
TEST_P(Surface, BlendsFromBackToFront) {
  const glm::dvec3 colors[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  Scene scene;
  scene.materials.push_back(unlitMaterial(glm::dvec3(0.5)));
  scene.meshes.push_back(quad());
  for (int i = 0; i < 3; ++i) {
    Material m = unlitMaterial(colors[i]);
    m.alphaMode = glint::AlphaMode::blend;
    m.alpha = 0.25;
    scene.materials.push_back(m);
    Mesh mesh = quad();
    mesh.material = i + 1;
    scene.meshes.push_back(mesh);
  }
  glm::dvec3 expected(0.5);
  for (const glm::dvec3& c : colors) expected = 0.25 * c + 0.75 * expected;
  const int orders[][4] = {{0, 1, 2, 3}, {3, 2, 1, 0}, {2, 0, 3, 1}};
  for (const auto& order : orders) {
    scene.instances.clear();
    for (int i : order) scene.instances.push_back({i, translation({0, 0, 0.25 * i})});
    // Binary fractions: exact.
    EXPECT_EQ(middle(draw(scene, parallelLook())), expected);
  }
  // Without a background: straight alpha of three panes, colours premultiplied.
  scene.instances.erase(std::remove_if(scene.instances.begin(), scene.instances.end(),
                                       [](const auto& i) { return i.mesh == 0; }),
                        scene.instances.end());
  Look look = parallelLook();
  look.noBackground = true;
  const glm::dvec4 through = pixel(draw(scene, look), 3, 3);
  glm::dvec4 over(0);
  for (const glm::dvec3& c : colors) over = glm::dvec4(0.25 * c, 0.25) + 0.75 * over;
  EXPECT_EQ(through, over);
}

// Blended surfaces are hidden by what is in front of them and hide nothing themselves.
TEST_P(Surface, BlendedThingsRespectDepthAndLeaveItAlone) {
  Scene scene = sceneOf(quad(), unlitMaterial(glm::dvec3(0.5)));
  Material m = unlitMaterial({1, 0, 0});
  m.alphaMode = glint::AlphaMode::blend;
  m.alpha = 0.5;
  scene.materials.push_back(m);
  Mesh pane = quad();
  pane.material = 1;
  scene.meshes.push_back(pane);
  scene.instances.push_back({1, translation({0, 0, -0.5})});
  EXPECT_EQ(middle(draw(scene, parallelLook())), glm::dvec3(0.5));
}

TEST_P(Surface, BackFacesAreDrawnOnlyWhereTheyAreWanted) {
  const SurfaceValues values{0.5, 0.6, 0.3, 10, 0, {0.8, 0.5, 0.2}};
  const glm::dvec3 n = unit({0.2, 0.1, 1}), l = unit({0.5, -0.2, 1});
  for (Shading shading : everyShading) {
    Look look = parallelLook({0, 0, 1}, 9);
    look.shading = shading;
    look.ambientLight = glm::dvec3(0.25);
    look.light = {directional(l)};
    Mesh mesh = quad(-n);
    mesh.indices = {0, 2, 1, 0, 3, 2};
    Material m = materialOf(0.5, 0.6, 0.3, 10, 0, {0.8, 0.5, 0.2});
    m.shading.ior = 1;
    EXPECT_EQ(coveredPixels(draw(sceneOf(mesh, m), look)), 0u);
    for (bool byLook : {false, true}) {
      look.twoSided = byLook;
      m.doubleSided = !byLook;
      const bool blinn = shading == Shading::blinnPhong || shading == Shading::environment;
      const glm::dvec3 normal = shading == Shading::flat ? glm::dvec3(0, 0, 1) : n;
      const glm::dvec3 lit = shaded(values, glm::dvec3(0.25), normal, l, {0, 0, 1}, blinn);
      expectColor(middle(draw(sceneOf(mesh, m), look)), lit, lobeTolerance(40) + 16 * rounding,
                  glint::shadingName(shading).data());
      // Their front faces are lit as usual.
      expectColor(middle(draw(sceneOf(quad(n), m), look)), lit, lobeTolerance(40) + 16 * rounding);
    }
  }
}

TEST_P(Surface, EmissionIsAddedAndUnlitShowsTheColourAlone) {
  for (Shading shading : everyShading) {
    Look look = parallelLook();
    look.shading = shading;
    look.ambientLight = glm::dvec3(0.5);
    look.light = {directional({0, 0, -1})};
    Material m = materialOf(1, 1, 0, 1, 0, {0.5, 0.25, 1});
    m.emission = {2, 0.125, 0};
    m.shading.ior = 1;
    EXPECT_EQ(middle(draw(sceneOf(quad(), m), look)), glm::dvec3(2.25, 0.25, 0.5));
    m.unlit = true;
    look.light = {directional({0, 0, 1}, glm::dvec3(100))};
    EXPECT_EQ(middle(draw(sceneOf(quad(), m), look)), glm::dvec3(0.5, 0.25, 1));
  }
}

TEST_P(Surface, VertexColoursMultiplyUnclamped) {  // F11 of colours
  for (Shading shading : everyShading) {
    Look look = parallelLook({0, 0, 1}, 9);
    look.shading = shading;
    look.ambientLight = glm::dvec3(1);
    look.noLights = true;
    Material m = materialOf(1, 1, 0, 1, 0, {0.5, 1, 0.25});
    m.shading.ior = 1;
    const Image image = draw(sceneOf(ramp({2, 0, 1, 1}, {0, 4, 1, 1}), m), look);
    for (int x = 0; x < 9; ++x) {
      const double t = (x + 0.5) / 9;
      expectColor(color(image, x, 2), {0.5 * 2 * (1 - t), 4 * t, 0.25}, interpolationTolerance(4));
    }
  }
}

// glTF 2.0, section 3.9.7: without normals they show the sum of base colour and emission.
TEST_P(Surface, PointsAndLinesAreUnlit) {
  for (Shading shading : everyShading)
    for (auto topology : {glint::Topology::points, glint::Topology::lines}) {
      Mesh mesh = quad({0, 0, 1}, 0.5f);
      mesh.normals.clear();
      mesh.topology = topology;
      mesh.indices = topology == glint::Topology::points
                         ? std::vector<std::uint32_t>{0, 1, 2, 3}
                         : std::vector<std::uint32_t>{0, 1, 1, 2, 2, 3, 3, 0};
      Look look = parallelLook({0, 0, 1}, 33);
      look.shading = shading;
      look.light = {directional({0, 0, 1}, glm::dvec3(50))};
      const glm::dvec3 c(0.5, 0.25, 0.75), e(0.125, 0.5, 0);
      Material m = materialOf(1, 1, 1, 1, 0, c);
      m.emission = e;
      const Image image = draw(sceneOf(mesh, m), look);
      const Scene scene = sceneOf(mesh, m);
      const Image exact = ReferenceRenderer(scene, {}, boundsOf(scene), look).draw();
      const std::size_t covered = coveredPixels(image);
      // Four points of one pixel; four lines of 16 or 17 pixels.
      EXPECT_GE(covered, topology == glint::Topology::points ? 4u : 60u);
      EXPECT_LE(covered, topology == glint::Topology::points ? 4u : 70u);
      for (int y = 0; y < 33; ++y)
        for (int x = 0; x < 33; ++x) {
          const glm::dvec3 p = color(image, x, y);
          EXPECT_TRUE(p == glm::dvec3(0) || p == c + e);
          EXPECT_EQ(p, color(exact, x, y));
        }
    }
}

// I7: half way between a lit and an unlit vertex is half the light, code 188, not code 128. F11:
// vertices brighter than 1 are not clamped.
TEST_P(Surface, GouraudInterpolatesInLinearLight) {
  Look look = parallelLook({0, 0, 1}, 9);
  look.shading = Shading::gouraud;
  look.light = {directional({0, 0, 1})};
  const Image image = draw(sceneOf(bent({0, 0, 1}, {1, 0, 0}), materialOf(0, 1, 0, 1)), look);
  for (int x = 0; x < 9; ++x)
    expectColor(color(image, x, 4), glm::dvec3(1 - (x + 0.5) / 9), interpolationTolerance(1));
  EXPECT_THAT(codes(middle(image)), testing::Each(188));
  look.light = {directional({0, 0, 1}, glm::dvec3(2))};
  const Image bright = draw(sceneOf(bent({0, 0, 1}, {1, 0, 0}), materialOf(0, 1, 0, 1)), look);
  expectColor(middle(bright), glm::dvec3(1), interpolationTolerance(2));
}

// One colour per face, computed at its centroid with its own normal, for any vertex normals.
TEST_P(Surface, FlatIsConstantOverEachFace) {
  Mesh mesh = bent({-1, 0.3, 0.5}, {1, 0, 0.2});
  mesh.positions[2].z = 0.4f;  // the two triangles have different planes
  Look look = parallelLook({0, 0, 1}, 32);
  look.shading = Shading::flat;
  Light point = lightOf(Light::Type::point);
  point.position = {0.3, 0.5, 1.5};
  look.light = {point};
  const SurfaceValues values{0, 0.7, 0.3, 15, 0, glm::dvec3(1)};
  const Image image = draw(sceneOf(mesh, materialOf(0, 0.7, 0.3, 15)), look);
  for (std::size_t face : {0u, 3u}) {
    const glm::dvec3 a(mesh.positions[mesh.indices[face]]),
        b(mesh.positions[mesh.indices[face + 1]]), c(mesh.positions[mesh.indices[face + 2]]);
    const glm::dvec3 center = (a + b + c) / 3.0, normal = unit(glm::cross(b - a, c - a));
    // The eye is at (0, 0, 4), in parallel projection: V is +Z everywhere.
    const glm::dvec3 expected =
        shaded(values, glm::dvec3(0), normal, unit(point.position - center), {0, 0, 1}, false);
    int count = 0;
    for (int y = 0; y < 32; ++y)
      for (int x = 0; x < 32; ++x) {
        // The first triangle lies below the diagonal from the lower left, the second above it.
        if (face == 0 ? x + y <= 31 : x + y >= 31) continue;
        const bool first = x > 31 - y;
        if (first != (face == 0)) continue;
        ++count;
        // Positions relative to the eye, 4 away, carry 4 roundings of 4.
        expectColor(color(image, x, y), expected, lobeTolerance(15) + 32 * rounding);
      }
    EXPECT_GT(count, 400);
  }
  std::vector<double> seen;
  for (float v : image.values) seen.push_back(v);
  std::sort(seen.begin(), seen.end());
  seen.erase(std::unique(seen.begin(), seen.end()), seen.end());
  EXPECT_LE(seen.size(), 4u);  // background 0, alpha 1 and two grey faces
}

// I3: between normals 90 degrees apart, the interpolated one has length 0.7071; renormalised it
// gives the full highlight, otherwise none.
TEST_P(Surface, InterpolatedNormalsAreRenormalised) {
  for (Shading shading : {Shading::phong, Shading::blinnPhong, Shading::environment}) {
    Look look = parallelLook({0, 0, 1}, 9);
    look.shading = shading;
    look.light = {directional({0, 0, 1})};
    Material m = materialOf(0, 0, 1, 100);
    m.shading.ior = 1;
    const Image image = draw(sceneOf(bent({-1, 0, 1}, {1, 0, 1}), m), look);
    // N = +Z up to the rounding of the interpolation, squared: 1 - a (8 roundings)^2.
    expectColor(middle(image), glm::dvec3(1), 4 * rounding, glint::shadingName(shading).data());
    for (int x = 0; x < 9; ++x) {
      const double t = (x + 0.5) / 9;
      const glm::dvec3 n = unit({2 * t - 1, 0, 1});
      const double power = shading == Shading::phong ? 100 : 400;
      const double expected = shading == Shading::phong ? phongLobe(n, {0, 0, 1}, {0, 0, 1}, power)
                                                        : blinnLobe(n, {0, 0, 1}, {0, 0, 1}, power);
      expectColor(color(image, x, 4), glm::dvec3(expected), lobeTolerance(power));
    }
  }
}

// I1, I2: where normals cancel, the face's is used.
TEST_P(Surface, VanishingNormalsGiveTheFacesOwn) {
  for (Shading shading : {Shading::phong, Shading::blinnPhong, Shading::environment})
    for (bool perspective : {false, true}) {
      Look look = parallelLook({0, 0, 1}, 9);
      look.cameraOrthographic = !perspective;
      look.shading = shading;
      look.light = {directional({0, 0, 1})};
      Material m = materialOf(0, 0.75, 0, 1);
      m.shading.ior = 1;
      Mesh mesh = bent({1, 0, 0}, {-1, 1e-20, 0});
      mesh.normalsMayCancel = true;
      const Image image = draw(sceneOf(mesh, m), look);
      EXPECT_TRUE(isFinite(image));
      // In the middle column the normals cancel; the face points to the light. Its normal comes
      // from differences of positions over a pixel, 2/9, accurate to 9 roundings of 4.
      expectColor(middle(image), glm::dvec3(0.75), 64 * rounding,
                  glint::shadingName(shading).data());
      mesh.normals.assign(4, glm::vec3(0));  // none anywhere (A1)
      expectColor(color(draw(sceneOf(mesh, m), look), 2, 5), glm::dvec3(0.75), 64 * rounding);
    }
}

TEST_P(Surface, BackgroundIsEncodedToItsCode) {
  Look look = parallelLook();
  look.backgroundColor = Look{}.backgroundColor;
  Scene nothing;
  nothing.materials.emplace_back();
  const Image image = draw(nothing, look);
  EXPECT_THAT(codes(middle(image)), testing::Each(0x33));
  EXPECT_EQ(pixel(image, 0, 0).w, 1);
}

// An edge pixel covered by k of n samples has alpha k/n, and its colour divided by alpha is the
// surface's: the background has not bled into it.
TEST_P(Surface, EdgesOverNoBackgroundHaveStraightAlpha) {
  const glm::dvec3 c(0.75, 0.5, 0.25);
  for (const AntiAliasing antiAliasing :
       {AntiAliasing{AntiAliasing::Mode::msaa, 4}, AntiAliasing{AntiAliasing::Mode::ssaa, 2},
        AntiAliasing{AntiAliasing::Mode::none, 1}}) {
    Look look = parallelLook({0, 0, 1}, 40);
    look.noBackground = true;
    look.backgroundColor = {1, 0, 1};  // must not show
    look.environmentBackground = true;
    look.antiAliasing = antiAliasing;
    const Image image = draw(sceneOf(quad({0, 0, 1}, 0.6f), unlitMaterial(c), rotation(0.4)), look);
    std::map<double, int> alphas;
    for (int y = 0; y < 40; ++y)
      for (int x = 0; x < 40; ++x) {
        const glm::dvec4 p = pixel(image, x, y);
        ++alphas[p.w];
        expectColor(glm::dvec3(p), p.w * c, 2 * rounding);
        if (p.w > 0 && p.w < 1) {
          std::uint8_t code[4];
          const float values[4] = {float(p.x), float(p.y), float(p.z), float(p.w)};
          glint::encodeSrgb8(values, 1, 1, code);
          EXPECT_THAT((std::array<int, 3>{code[0], code[1], code[2]}), codes(c));
          EXPECT_EQ(code[3], std::lround(255 * p.w));
        }
      }
    EXPECT_GT(alphas[0], 300);
    EXPECT_GT(alphas[1], 300);
    if (antiAliasing.mode == AntiAliasing::Mode::none) {
      EXPECT_EQ(alphas.size(), 2u);
    } else {
      EXPECT_EQ(alphas.size(), 5u);  // 0, 1/4 .. 1
      for (const auto& [alpha, count] : alphas) EXPECT_EQ(alpha * 4, std::round(alpha * 4));
    }
  }
}

// Each pixel shows its own position, in every tile of a wide and of a high picture: far more
// accurately than the one pixel by which a tile might be shifted.
TEST_P(Surface, TilesShowTheirPartOfThePicture) {
  for (const glm::ivec2 resolution : {glm::ivec2(8200, 6), glm::ivec2(40, 1500)}) {
    Look look = parallelLook();
    look.resolution = resolution;
    if (resolution.y > 1000) look.antiAliasing = {AntiAliasing::Mode::ssaa, 6};
    const double aspect = double(resolution.x) / resolution.y;
    Mesh mesh = quad({0, 0, 1}, 1);
    for (glm::vec3& p : mesh.positions) p.x *= float(aspect);
    mesh.colors = {{0, 0, 0, 1}, {1, 0, 0, 1}, {1, 1, 0, 1}, {0, 1, 0, 1}};
    const Image image = draw(sceneOf(mesh, unlitMaterial()), look);
    glm::dvec2 most(0);  // in pixels
    for (int y = 0; y < resolution.y; ++y)
      for (int x = 0; x < resolution.x; ++x) {
        const glm::dvec2 seen(color(image, x, y));
        const glm::dvec2 place(x + 0.5, resolution.y - y - 0.5);
        most = glm::max(most, glm::abs(seen * glm::dvec2(resolution) - place));
      }
    // Vertices are snapped to 1/256 pixel at each end of the ramp; colours carry 8 roundings.
    for (int i = 0; i < 2; ++i) EXPECT_LT(most[i], 2.0 / 256 + 8 * rounding * resolution[i]) << i;
  }
}

// G5: attributes of an inclined surface compared with the ray through each pixel.
TEST_P(Surface, InterpolationIsPerspectiveCorrect) {
  Mesh mesh = quad({0, 0, 1}, 1);
  // From 1 to 10 in front of the eye, seen from above.
  mesh.positions = {{-1, -1, -1}, {1, -1, -1}, {10, -1, -10}, {-10, -1, -10}};
  mesh.colors = {{0, 0, 0, 1}, {0, 0, 0, 1}, {1, 0, 0, 1}, {1, 0, 0, 1}};
  Material m = unlitMaterial();
  m.doubleSided = true;
  Look look = parallelLook({0, 0, 1}, 65);
  look.cameraOrthographic = false;
  look.cameraPosition = glm::dvec3(0, 0, 0);
  look.cameraFocalPoint = glm::dvec3(0, 0, -1);
  look.cameraViewAngle = 90;
  const Image image = draw(sceneOf(mesh, m), look);
  int seen = 0;
  for (int y = 33; y < 65; ++y) {
    const double slope = (y + 0.5) / 65 * 2 - 1;  // down per distance
    const double z = 1 / slope;                   // distance at which the ray meets y = -1
    if (z < 1.05 || z > 9.5) continue;
    ++seen;
    // Edges snapped to 1/256 pixel move the depth by z^2 2/65/256 per ray.
    EXPECT_NEAR(color(image, 32, y).x, (z - 1) / 9, z * z * 2 / 65 / 256 / 9 + 16 * rounding) << y;
  }
  EXPECT_GT(seen, 20);
}

TEST_P(Surface, NearThingsHideFarOnesOverAGreatRange) {  // G1
  Scene scene = sceneOf(quad({0, 0, 1}, 50), unlitMaterial({1, 0, 0}));
  scene.materials.push_back(unlitMaterial({0, 1, 0}));
  Mesh mesh = quad({0, 0, 1}, 50);
  mesh.material = 1;
  scene.meshes.push_back(mesh);
  Look look = parallelLook();
  look.cameraOrthographic = false;
  look.cameraPosition = glm::dvec3(0, 0, 0);
  look.cameraFocalPoint = glm::dvec3(0, 0, -1);
  look.clippingRange = glm::dvec2(1e-3, 1e7);
  for (bool swapped : {false, true}) {
    scene.instances = {{swapped ? 1 : 0, translation({0, 0, -100.1})},
                       {swapped ? 0 : 1, translation({0, 0, -100})}};
    EXPECT_EQ(middle(draw(scene, look)), swapped ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0));
  }
}

TEST_P(Surface, TrianglesThroughTheNearPlaneAreFinite) {  // G4, G9
  for (Shading shading : everyShading) {
    Look look = parallelLook({0, 0, 1}, 32);
    look.shading = shading;
    look.cameraOrthographic = false;
    look.cameraPosition = glm::dvec3(0, 0, 0);  // inside the sphere
    look.cameraFocalPoint = glm::dvec3(0.3, 0.2, -1);
    look.cameraViewAngle = 100;
    look.twoSided = true;
    look.ambientLight = glm::dvec3(0.5);
    const Image inside = draw(sceneOf(sphere(24, 12), materialOf(1, 1, 1, 10)), look);
    EXPECT_TRUE(isFinite(inside));
    EXPECT_EQ(coveredPixels(inside), 32u * 32u);
    look.cameraPosition = glm::dvec3(0, 0.1, 0.5);
    EXPECT_TRUE(
        isFinite(draw(sceneOf(quad({0, 1, 0}, 3), materialOf(1, 1, 1, 10), rotation(1.5)), look)));
  }
}

INSTANTIATE_TEST_SUITE_P(Render, Surface, softwareBackends(), nameOfBackend);

}  // namespace glint::test::render_surface_gl_test
