// The reference's coverage and interpolation.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "reference_scenes.h"

namespace glint::reference_raster_test {

using namespace scenes;

// Twice the area of (a, b, p), in quarters of a pixel, exact.
long cross(glm::ivec2 a, glm::ivec2 b, glm::ivec2 p) {
  return long(b.x - a.x) * (p.y - a.y) - long(b.y - a.y) * (p.x - a.x);
}

// Exact, y upwards, counter-clockwise: samples on a left edge (going down) or on a horizontal
// bottom edge (going right) are inside.
bool covers(const std::array<glm::ivec2, 3>& t, glm::ivec2 p) {
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::ivec2 a = t[i], b = t[(i + 1) % 3];
    const long side = cross(a, b, p);
    const bool owned = b.y < a.y || (b.y == a.y && b.x > a.x);
    if (side < 0 || (side == 0 && !owned)) return false;
  }
  return true;
}

TEST(ReferenceCoverage, AgreesWithIntegerArithmetic) {
  constexpr int size = 32;
  std::mt19937 random(7);
  std::uniform_int_distribution<int> place(-4, 36), quarter(0, 3), coarse(0, 2);
  for (int trial = 0; trial < 300; ++trial) {
    std::array<glm::ivec2, 3> t;
    for (auto& v : t) {
      // In a third of the trials only pixel centres, where every vertex is a tie.
      const bool centers = trial % 3 == 0;
      for (int i = 0; i < 2; ++i) v[i] = 4 * place(random) + (centers ? 2 : quarter(random));
    }
    if (cross(t[0], t[1], t[2]) < 0) std::swap(t[1], t[2]);
    std::vector<glm::vec3> corners;
    for (const auto& v : t) corners.emplace_back(v.x / 4.0f - 16, v.y / 4.0f - 16, 0);
    Scene scene = sceneOf({{triangles(corners), Material{}}});
    Look look = plainLook(size, size);
    lookAlongZ(scene, look, size / 2);
    const auto seen = referenceOf(scene, look).attributes(0, size);
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x) {
        const glm::ivec2 center(4 * x + 2, 4 * (size - 1 - y) + 2);
        ASSERT_EQ(seen[std::size_t(y * size + x)].item >= 0, covers(t, center))
            << "trial " << trial << " pixel " << x << "," << y;
      }
  }
}

// A fan around a pixel centre, blended: each sample is drawn exactly once.
TEST(ReferenceCoverage, SharedEdgesAreDrawnOnce) {
  std::vector<glm::vec3> corners;
  const glm::vec2 middle(0.5f, 0.5f);
  std::vector<glm::vec2> rim;
  for (int i = 0; i < 16; ++i) {
    static constexpr int x[] = {8, 8, 8, 4, 0, -4, -8, -8}, y[] = {0, 4, 8, 8, 8, 8, 8, 4};
    const float sign = i < 8 ? 1.0f : -1.0f;
    rim.push_back(middle + sign * glm::vec2(x[i % 8], y[i % 8]));
  }
  for (std::size_t i = 0; i < 16; ++i)
    for (const glm::vec2& v : {middle, rim[i], rim[(i + 1) % 16]}) corners.emplace_back(v, 0.0f);
  Material half;
  half.alpha = 0.5;
  half.alphaMode = glint::AlphaMode::blend;
  half.unlit = true;
  Scene scene = sceneOf({{triangles(corners), half}});
  Look look = plainLook(32, 32);
  look.backgroundColor = glm::dvec3(0.0);
  lookAlongZ(scene, look, 16);
  const auto image = draw(scene, look);
  int covered = 0;
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 32; ++x) {
      const double value = pixel(image, x, y).r;
      EXPECT_TRUE(value == 0 || value == 0.5) << x << "," << y << ": " << value;
      covered += value == 0.5;
    }
  EXPECT_EQ(covered, 256);  // 16 x 16, with one of each pair of opposite sides
}

// docs/science.md G5: w from 1 to 10 across the picture; the middle value is 1/11, not 1/2.
TEST(ReferenceInterpolation, IsPerspectiveCorrect) {
  Mesh mesh = rectangle({-1, -1}, {1, 1});
  mesh.positions = {{-1, -1, -1}, {10, -10, -10}, {10, 10, -10}, {-1, 1, -1}};
  mesh.colors = {{0, 0, 0, 1}, {1, 1, 1, 1}, {1, 1, 1, 1}, {0, 0, 0, 1}};
  Material unlit;
  unlit.unlit = unlit.doubleSided = true;
  Scene scene = sceneOf({{mesh, unlit}});
  Look look = plainLook(101, 101);
  lookFromOrigin(scene, look, 1, 0.5, 20);
  const auto image = draw(scene, look);
  EXPECT_NEAR(pixel(image, 50, 50).r, 1.0 / 11, 1e-8);
  for (int x = 0; x < 101; ++x) {
    const double s = (x + 0.5) / 101;  // across the screen
    EXPECT_NEAR(pixel(image, x, 30).r, (s / 10) / ((1 - s) + s / 10), 1e-7) << x;
  }
}

// docs/science.md G4: a floor from behind the eye to far ahead. It covers the pixels whose ray
// meets it between near and far plane, with the position of that intersection.
TEST(ReferenceClipping, AFloorThroughTheEyesPlane) {
  const double near = 0.5, far = 40;
  Mesh mesh = triangles({{-100, -1, 50}, {100, -1, 50}, {0, -1, -100}});
  Material unlit;
  unlit.unlit = unlit.doubleSided = true;
  Scene scene = sceneOf({{mesh, unlit}});
  Look look = plainLook(64, 64);
  lookFromOrigin(scene, look, 1, near, far);
  const glint::ReferenceRenderer renderer = referenceOf(scene, look);
  const auto seen = renderer.attributes(0, 64);
  const double unit = renderer.stage().camera.unit;
  int covered = 0;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      const auto& a = seen[std::size_t(y * 64 + x)];
      const double right = (x + 0.5) / 32 - 1, up = 1 - (y + 0.5) / 32;
      const double distance = -1 / up;  // along the view, to where the ray meets y = -1
      const bool inTriangle = up < 0 && std::abs(right * distance) < 100 * (100 - distance) / 150;
      const bool hit = inTriangle && distance > near && distance < far;
      ASSERT_EQ(a.item >= 0, hit) << x << "," << y;
      if (!hit) continue;
      ++covered;
      EXPECT_NEAR(a.position.x * unit, right * distance, 1e-11 * distance);
      EXPECT_NEAR(a.position.y * unit, -1, 1e-11);
      EXPECT_NEAR(a.position.z * unit, -distance, 1e-11 * distance);
    }
  EXPECT_GT(covered, 1000);
}

TEST(ReferenceDepth, OfCoincidentSurfacesTheFirstDrawnIsSeen) {
  Material red, green;
  red.unlit = green.unlit = true;
  red.shading.color = {1, 0, 0};
  green.shading.color = {0, 1, 0};
  Mesh one = triangles({{-3, -2, 0.3f}, {2.7f, -2.2f, -0.9f}, {0.2f, 3.1f, 1.1f}});
  Mesh turned = one;
  turned.indices = {1, 2, 0};
  for (int order = 0; order < 2; ++order) {
    Scene scene = order == 0 ? sceneOf({{one, red}, {turned, green}})
                             : sceneOf({{turned, green}, {one, red}});
    const auto image = draw(scene, plainLook(48, 48));
    const auto background = glm::dvec3(0.0331047665);
    for (int y = 0; y < 48; ++y)
      for (int x = 0; x < 48; ++x) {
        const glm::dvec3 c(pixel(image, x, y));
        if (std::abs(c.b - background.b) < 1e-6) continue;
        EXPECT_EQ(c, order == 0 ? red.shading.color : green.shading.color) << x << "," << y;
      }
  }
}

// Whatever the order of their vertices, the sides that they show, and their places in meshes.
TEST(ReferenceDepth, OfCoincidentBlendedSurfacesTheLastDrawnLiesOnTop) {
  Material glass;
  glass.unlit = glass.doubleSided = true;
  glass.alphaMode = glint::AlphaMode::blend;
  glass.alpha = 0.5;
  Material red = glass, green = glass;
  red.shading.color = {1, 0, 0};
  green.shading.color = {0, 1, 0};
  const Mesh one = triangles({{-3, -2, 0.3f}, {2.7f, -2.2f, -0.9f}, {0.2f, 3.1f, 1.1f}});
  const auto above = [](const glm::dvec3& top, const glm::dvec3& below) {
    return 0.5 * top + 0.5 * (0.5 * below + 0.5 * glm::dvec3(0.0331047665));
  };
  for (const std::vector<std::uint32_t>& order :
       {std::vector<std::uint32_t>{0, 1, 2}, {1, 2, 0}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}) {
    Mesh turned = one;
    turned.indices = order;
    for (const bool first : {false, true}) {
      const Scene scene =
          first ? sceneOf({{turned, green}, {one, red}}) : sceneOf({{one, red}, {turned, green}});
      const glm::dvec3 expected = first ? above(red.shading.color, green.shading.color)
                                        : above(green.shading.color, red.shading.color);
      const auto image = draw(scene, plainLook(48, 48));
      int covered = 0;
      for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 48; ++x) {
          const glm::dvec3 c(pixel(image, x, y));
          if (std::abs(c.r - c.b) < 1e-6) continue;
          ++covered;
          ASSERT_NEAR(glm::length(c - expected), 0, 1e-6) << x << "," << y << " " << first;
        }
      EXPECT_GT(covered, 300);
    }
  }
}

TEST(ReferenceDepth, TheNearerIsSeenWhateverTheOrder) {
  Material red, green;
  red.unlit = green.unlit = true;
  red.shading.color = {1, 0, 0};
  green.shading.color = {0, 1, 0};
  // Separated by 1e-9 of their distance, which float depth could not resolve.
  Mesh near = rectangle({-4, -4}, {4, 4}), far = near;
  near.origin = {0, 0, 1e-8};
  for (int order = 0; order < 2; ++order) {
    Scene scene =
        order == 0 ? sceneOf({{near, red}, {far, green}}) : sceneOf({{far, green}, {near, red}});
    Look look = plainLook(4, 4);
    lookAlongZ(scene, look, 1);
    EXPECT_EQ(glm::dvec3(pixel(draw(scene, look), 1, 2)), red.shading.color);
  }
}

TEST(ReferenceMirror, AMirroredNodeGivesTheMirroredPicture) {
  Mesh mesh = triangles({{-0.71f, -0.53f, 0.11f},
                         {0.93f, -0.32f, 0.4f},
                         {0.13f, 0.87f, -0.3f},
                         {0.93f, -0.32f, 0.4f},
                         {1.21f, 0.77f, -0.6f},
                         {0.13f, 0.87f, -0.3f}});
  mesh.normals = {
      glm::normalize(glm::vec3(-0.4f, -0.2f, 1)), glm::normalize(glm::vec3(0.5f, 0, 1)),
      glm::normalize(glm::vec3(0, 0.6f, 1)),      glm::normalize(glm::vec3(0.5f, 0, 1)),
      glm::normalize(glm::vec3(1, 0.2f, 1)),      glm::normalize(glm::vec3(0, 0.6f, 1))};
  Material shiny;
  shiny.shading.specular = 0.7;
  for (const auto shading : {glint::Shading::flat, glint::Shading::gouraud, glint::Shading::phong,
                             glint::Shading::environment}) {
    Look look = plainLook(64, 48, shading);
    look.environment = glint::Environment::white;
    look.cameraPosition = glm::dvec3(0, 0.3, 5);
    look.cameraFocalPoint = glm::dvec3(0, 0.3, 0);
    glint::Light light;
    light.direction = {0.4, 0.5, 1};
    look.light = std::vector{light};
    const auto plain = draw(sceneOf({{mesh, shiny}}), look);
    Scene mirrored = sceneOf({{mesh, shiny}});
    mirrored.instances[0].world[0][0] = -1;
    look.light->front().direction.x = -0.4;
    const auto image = draw(mirrored, look);
    for (int y = 0; y < 48; ++y)
      for (int x = 0; x < 64; ++x)
        for (int c = 0; c < 4; ++c)
          ASSERT_NEAR(pixel(image, 63 - x, y)[c], pixel(plain, x, y)[c], 1e-7)
              << x << "," << y << " program " << int(shading);
  }
}

TEST(ReferencePoints, CoverThePixelTheyLieIn) {
  Mesh mesh;
  mesh.topology = glint::Topology::points;
  mesh.positions = {{0.25f, 0.25f, 0}, {-3.75f, 2.75f, 0}, {100, 0, 0}};
  mesh.indices = {0, 1, 2};
  Scene scene = sceneOf({{mesh, Material{}}});
  Look look = plainLook(16, 16);
  look.noBackground = true;
  lookAlongZ(scene, look, 8);
  const auto image = draw(scene, look);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x)
      EXPECT_EQ(pixel(image, x, y).a, (x == 8 && y == 7) || (x == 4 && y == 5)) << x << "," << y;
}

TEST(ReferenceLines, OnePixelAColumnOrRowWithoutTheEnd) {
  Mesh mesh;
  mesh.topology = glint::Topology::lines;
  mesh.positions = {{-6, 1.25f, 0}, {6, 1.25f, 0}, {-2.75f, -7, 0}, {-2.75f, -3, 0}};
  mesh.indices = {0, 1, 2, 3};
  Scene scene = sceneOf({{mesh, Material{}}});
  Look look = plainLook(16, 16);
  look.noBackground = true;
  lookAlongZ(scene, look, 8);
  const auto image = draw(scene, look);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) {
      const bool level = y == 6 && x >= 2 && x < 14, upright = x == 5 && y >= 11 && y < 15;
      EXPECT_EQ(pixel(image, x, y).a, level || upright) << x << "," << y;
    }
}

TEST(ReferenceThreads, MakeNoDifference) {
  Mesh mesh = triangles({});
  std::mt19937 random(3);
  std::uniform_real_distribution<float> place(-3, 3);
  for (int i = 0; i < 300; ++i)
    mesh.positions.emplace_back(place(random), place(random), place(random));
  mesh.normals.assign(300, glm::vec3(0, 0, 1));
  for (std::uint32_t i = 0; i < 300; ++i) mesh.indices.push_back(i);
  Material glass;
  glass.alphaMode = glint::AlphaMode::blend;
  glass.alpha = 0.4;
  Scene scene = sceneOf({{mesh, Material{}}, {mesh, glass}});
  scene.instances[1].world[3] = glm::dvec4(0.5, 0.2, 0.1, 1);
  Look look = plainLook(90, 130);
  look.twoSided = true;
  look.antiAliasing = {glint::AntiAliasing::Mode::ssaa, 2};
  const auto one = draw(scene, look, {}, 1);
  for (int threads : {2, 5}) EXPECT_EQ(draw(scene, look, {}, threads).values, one.values);
  auto renderer = referenceOf(scene, look, {}, 3);
  glint::Image rows;
  std::vector<float> pieces;
  for (int y = 0; y < 130; y += 7) {
    renderer.drawRows(y, std::min(7, 130 - y), rows);
    pieces.insert(pieces.end(), rows.values.begin(), rows.values.end());
  }
  EXPECT_EQ(pieces, one.values);
  EXPECT_EQ(renderer.rowsDone(), 130);
}

TEST(ReferenceSupersampling, IsTheMeanOfTheSamples) {
  Scene scene = sceneOf({{triangles({{-3, -2, 0}, {3, -1, 0}, {0, 3, 0}}), Material{}}});
  Look look = plainLook(20, 12);
  look.antiAliasing = {glint::AntiAliasing::Mode::ssaa, 3};
  const auto smooth = draw(scene, look);
  const auto fine = draw(scene, plainLook(60, 36));
  for (int y = 0; y < 12; ++y)
    for (int x = 0; x < 20; ++x) {
      glm::dvec4 sum(0.0);
      for (int i = 0; i < 9; ++i) sum += pixel(fine, 3 * x + i % 3, 3 * y + i / 3);
      for (int c = 0; c < 4; ++c) EXPECT_NEAR(pixel(smooth, x, y)[c], sum[c] / 9, 1e-7);
    }
}

}  // namespace glint::reference_raster_test
