// Pictures of the reference compared with closed forms written here.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "files.h"
#include "glint/gltf/scene_file.h"
#include "glint/image/error.h"
#include "reference_scenes.h"

namespace glint::reference_shading_test {

using namespace scenes;

// Of the pixel's float, not of the double before it.
constexpr double floatRounding = 1.2e-7;

glint::Light directional(glm::dvec3 to, glm::dvec3 intensity = glm::dvec3(1.0)) {
  glint::Light light;
  light.direction = to;
  light.intensity = intensity;
  return light;
}

Material paint() {
  Material m;
  m.shading.ambient = 0.7;
  m.shading.diffuse = 0.8;
  m.shading.specular = 0.5;
  m.shading.exponent = 10;
  m.shading.metalness = 0.25;
  m.shading.color = {0.9, 0.5, 0.1};
  return m;
}

void expectColor(const glm::dvec4& seen, const glm::dvec3& expected, double tolerance,
                 const std::string& where = {}) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], expected[c], tolerance) << where << " c" << c;
}

// A plane across the picture, viewed frontally: one colour, by the sum of docs/architecture.md.
TEST(ReferenceShading, APlaneUnderADirectionalLight) {
  const glm::dvec3 L = glm::normalize(glm::dvec3(0.3, -0.2, 0.8)), N(0, 0, 1);
  const glm::dvec3 C(0.9, 0.5, 0.1), A(0.1, 0.2, 0.3), I(0.6, 0.7, 2), S = 0.25 * C + 0.75;
  const double NoL = L.z, RoV = 2 * NoL * N.z - L.z, NoH = std::sqrt((1 + L.z) / 2);
  Scene scene = sceneOf({{rectangle({-9, -9}, {9, 9}), paint()}});
  for (const Shading shading :
       {Shading::flat, Shading::gouraud, Shading::phong, Shading::blinnPhong}) {
    Look look = plainLook(9, 7, shading);
    lookAlongZ(scene, look, 4);
    look.light = std::vector{directional(L, I)};
    look.ambientLight = A;
    const double lobe = shading == Shading::blinnPhong ? std::pow(NoH, 40) : std::pow(RoV, 10);
    const glm::dvec3 expected = 0.7 * C * A + 0.8 * C * I * NoL + 0.5 * S * I * lobe;
    const auto image = draw(scene, look);
    for (int y = 0; y < 7; ++y)
      for (int x = 0; x < 9; ++x) expectColor(pixel(image, x, y), expected, floatRounding * 2);
    look.highlight = glint::Highlight::pow;
    expectColor(pixel(draw(scene, look), 3, 3), expected, floatRounding * 2);
  }
}

// Point and spot lights and a local viewer: every pixel has its own L and V.
TEST(ReferenceShading, APlaneUnderPointAndSpotLights) {
  const double height = 3;
  Scene scene = sceneOf({{rectangle({-9, -9}, {9, 9}, float(-height)), paint()}});
  Look look = plainLook(32, 24, Shading::blinnPhong);
  lookFromOrigin(scene, look, 0.75, 0.1, 50);
  glint::Light point, spot;
  point.type = glint::Light::Type::point;
  point.position = {0.5, -0.25, -1};
  spot.type = glint::Light::Type::spot;
  spot.position = {-1, 1, -0.5};
  spot.direction = {0.2, -0.3, -1};
  spot.innerAngle = 10;
  spot.outerAngle = 35;
  spot.intensity = {0.2, 0.4, 3};
  look.light = std::vector{point, spot};
  look.ambientLight = glm::dvec3(0.0);
  const auto image = draw(scene, look);
  const glm::dvec3 C(0.9, 0.5, 0.1), S = 0.25 * C + 0.75, N(0, 0, 1);
  for (int y = 0; y < 24; ++y)
    for (int x = 0; x < 32; ++x) {
      const glm::dvec3 P =
          height * glm::dvec3(((x + 0.5) / 16 - 1), 0.75 * (1 - (y + 0.5) / 12), -1);
      glm::dvec3 sum(0.0);
      for (const glint::Light& light : *look.light) {
        const glm::dvec3 L = glm::normalize(light.position - P), V = glm::normalize(-P);
        double share = 1;
        if (light.type == glint::Light::Type::spot) {
          const double inner = std::cos(10 * 0.017453292519943295);
          const double outer = std::cos(35 * 0.017453292519943295);
          const double c = glm::dot(-L, glm::normalize(light.direction));
          share = std::pow(std::clamp((c - outer) / (inner - outer), 0.0, 1.0), 2);
        }
        const glm::dvec3 I = share * light.intensity;
        const double NoH = glm::dot(N, glm::normalize(L + V));
        sum += 0.8 * C * I * L.z + 0.5 * S * I * std::pow(NoH, 40);
      }
      expectColor(pixel(image, x, y), sum, 3 * floatRounding,
                  std::to_string(x) + "," + std::to_string(y));
    }
}

// Flat: one value per face, at its centroid. Gouraud: interpolated values of the vertices.
TEST(ReferenceShading, FlatAndGouraudCarryTheLight) {
  Mesh mesh = triangles({{-4, -3, 0}, {5, -3, 0.5f}, {0, 4, 1}});
  mesh.normals = {glm::normalize(glm::vec3(-1, 0, 2)), glm::normalize(glm::vec3(1, 0.5f, 2)),
                  glm::vec3(0, 0, 1)};
  Scene scene = sceneOf({{mesh, paint()}});
  glint::Light point;
  point.type = glint::Light::Type::point;
  point.position = {1, 0.5, 3};
  const auto phongAt = [&](const glm::dvec3& P, const glm::dvec3& N, glm::dvec3& specular) {
    const glm::dvec3 L = glm::normalize(point.position - P), R = 2 * glm::dot(N, L) * N - L;
    const double NoL = glm::dot(N, L);
    specular = glm::dvec3(NoL > 0 ? 0.5 * std::pow(std::max(R.z, 0.0), 10) : 0);
    return glm::dvec3(0.07 + 0.8 * std::max(NoL, 0.0));
  };
  const glm::dvec3 C(0.9, 0.5, 0.1), S = 0.25 * C + 0.75;
  const glm::dvec3 a(mesh.positions[0]), b(mesh.positions[1]), c(mesh.positions[2]);
  for (const Shading shading : {Shading::flat, Shading::gouraud}) {
    Look look = plainLook(16, 16, shading);
    lookAlongZ(scene, look, 4);
    look.light = std::vector{point};
    const auto image = draw(scene, look);
    for (int y = 0; y < 16; ++y)
      for (int x = 0; x < 16; ++x) {
        const glm::dvec2 p((x + 0.5) / 2 - 4, 4 - (y + 0.5) / 2);
        const glm::dmat3 toXy(glm::dvec3(a.x, a.y, 1), glm::dvec3(b.x, b.y, 1),
                              glm::dvec3(c.x, c.y, 1));
        const glm::dvec3 weights = glm::inverse(toXy) * glm::dvec3(p, 1);
        if (std::min({weights.x, weights.y, weights.z}) < 1e-3) continue;
        glm::dvec3 matte(0.0), specular(0.0), part;
        if (shading == Shading::flat) {
          matte = phongAt((a + b + c) / 3.0, glm::normalize(glm::cross(b - a, c - a)), specular);
        } else {
          for (int i = 0; i < 3; ++i) {
            matte += weights[i] * phongAt(glm::dvec3(mesh.positions[std::size_t(i)]),
                                          glm::dvec3(mesh.normals[std::size_t(i)]), part);
            specular += weights[i] * part;
          }
        }
        // Vertex normals are floats: 6e-8, ten times steeper in the lobe.
        expectColor(pixel(image, x, y), C * matte + S * specular, 1e-6);
      }
  }
}

// A glass plane in a white room: what is not reflected is transmitted, so the result is 1.
TEST(ReferenceEnvironment, AWhiteFurnaceStaysWhite) {
  Material glass;
  glass.shading.transmission = 1;
  glass.shading.ambient = 0;
  glass.doubleSided = true;
  for (const double ior : {1.0, 1.5, 2.4, 0.7}) {
    glass.shading.ior = ior;
    Scene scene = sceneOf({{rectangle({-50, -50}, {50, 50}, -2), glass}});
    for (const double turn : {0.0, 3.14159}) {  // from the back as well: total reflection
      scene.instances[0].world[0][0] = scene.instances[0].world[2][2] = std::cos(turn);
      scene.instances[0].world[3].z = turn > 0 ? -4 : 0;
      Look look = plainLook(32, 32, Shading::environment);
      lookFromOrigin(scene, look, 4, 0.1, 100);
      look.noLights = true;
      look.environment = glint::Environment::white;
      const auto image = draw(scene, look);
      for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x)
          ASSERT_NEAR(pixel(image, x, y).g, 1, floatRounding) << ior << " " << turn;
    }
  }
}

TEST(ReferenceEnvironment, AMetalMirrorsTheSky) {
  Material metal;
  metal.shading.metalness = 1;
  metal.shading.ambient = 0;
  metal.shading.color = {0.9, 0.6, 0.2};
  Scene scene = sceneOf({{rectangle({-50, -50}, {50, 50}, -2), metal}});
  Look look = plainLook(16, 16, Shading::environment);
  lookFromOrigin(scene, look, 1, 0.1, 100);
  look.noLights = true;
  look.environment = glint::Environment::sky;
  look.environmentRotation = 90;
  const auto image = draw(scene, look);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) {
      const glm::dvec3 d = glm::normalize(glm::dvec3((x + 0.5) / 8 - 1, 1 - (y + 0.5) / 8, -1));
      const glm::dvec3 F = metal.shading.color + (1.0 - metal.shading.color) * std::pow(1 + d.z, 5);
      // Mirrored by the plane, then looked up in an environment rotated by 90 degrees about +Y.
      const glm::dvec3 back(-(-d.z), d.y, d.x);
      const glm::dvec3 E = environmentRadiance(glint::BuiltinEnvironment::sky, back);
      expectColor(pixel(image, x, y), F * E, 3 * floatRounding);
    }
}

TEST(ReferenceEnvironment, BehindTheModel) {
  Scene scene = sceneOf({{rectangle({-1, -1}, {1, 1}, 9), Material{}}});  // behind the eye
  Look look = plainLook(16, 8);
  lookFromOrigin(scene, look, 0.5, 0.1, 100);
  look.environmentBackground = true;
  const auto image = draw(scene, look);
  const glm::dvec3 ray(1.0 * (2 * 3.5 / 16 - 1), 0.5 * (1 - 2 * 5.5 / 8), -1);
  expectColor(pixel(image, 3, 5), environmentRadiance(glint::BuiltinEnvironment::studio, ray),
              floatRounding);
  look.noBackground = true;
  EXPECT_EQ(pixel(draw(scene, look), 3, 5), glm::dvec4(0.0));
}

TEST(ReferenceBlending, BackToFrontOverTheBackground) {
  Material low, high;
  low.unlit = high.unlit = true;
  low.alphaMode = high.alphaMode = glint::AlphaMode::blend;
  low.alpha = 0.5;
  high.alpha = 0.25;
  low.shading.color = {1, 0, 0};
  high.shading.color = {0, 1, 0};
  // The nearer one comes first in the file.
  Scene scene =
      sceneOf({{rectangle({-9, -9}, {9, 9}, 1), high}, {rectangle({-9, -9}, {9, 9}), low}});
  Look look = plainLook(4, 4);
  look.backgroundColor = {0, 0, 1};
  lookAlongZ(scene, look, 2);
  EXPECT_EQ(pixel(draw(scene, look), 1, 1), glm::dvec4(0.375, 0.25, 0.375, 1));
  look.noBackground = true;
  EXPECT_EQ(pixel(draw(scene, look), 1, 1), glm::dvec4(0.375, 0.25, 0, 0.625));
}

TEST(ReferenceNormals, WhereTheyCancelTheFacesStandsIn) {
  Mesh mesh = triangles({{-4, -4, 0}, {4, -4, 0}, {0, 4, 0}});
  mesh.normals = {{1, 0, 0}, {-1, 0, 0}, {0, 0, 1}};
  mesh.normalsMayCancel = true;
  Scene scene = sceneOf({{mesh, Material{}}});
  Look look = plainLook(15, 15);
  lookAlongZ(scene, look, 4);
  look.light = std::vector{directional({0, 0, 1})};
  look.ambientLight = glm::dvec3(0.0);
  // At the foot of the symmetry axis, 1/30 up: weights 0.483, 0.483, 0.033.
  EXPECT_NEAR(pixel(draw(scene, look), 7, 14).r, 1, floatRounding);
  mesh.normals[2] = glm::vec3(0, 0, 1e-4f);
  scene = sceneOf({{mesh, Material{}}});
  lookAlongZ(scene, look, 4);
  for (int y = 0; y < 15; ++y) EXPECT_TRUE(std::isfinite(pixel(draw(scene, look), 7, y).r));
}

TEST(ReferenceNormals, BackFacesTurnThem) {
  Material both;
  both.doubleSided = true;
  Mesh mesh = rectangle({-9, -9}, {9, 9});
  mesh.indices = {0, 2, 1, 0, 3, 2};  // seen from the back
  mesh.normals.assign(4, glm::vec3(0, 0, -1));
  for (const Shading shading : {Shading::flat, Shading::gouraud, Shading::phong}) {
    Scene scene = sceneOf({{mesh, both}});
    Look look = plainLook(5, 5, shading);
    lookAlongZ(scene, look, 4);
    look.light = std::vector{directional({0, 0.6, 0.8})};
    look.ambientLight = glm::dvec3(0.0);
    EXPECT_NEAR(pixel(draw(scene, look), 2, 2).r, 0.8, floatRounding) << int(shading);
    scene.materials[0].doubleSided = false;
    look.noBackground = true;
    EXPECT_EQ(pixel(draw(scene, look), 2, 2).a, 0);
  }
}

// The shipped sphere under a light from the side of the camera, compared with the exact sphere at
// the same image point. The angles of interpolated normals are off by at most h^2 / 2
// (docs/science.md 5.2: 4e-5 at h = 0.0094), where h is the longest edge.
TEST(ReferenceSphere, IsASphereUpToItsFacets) {
  Scene scene = glint::loadGltf(GLINT_SOURCE_DIR "/models/sphere.glb");
  const Mesh& mesh = scene.meshes[0];
  double h = 0;
  for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
    const std::size_t next = i % 3 == 2 ? i - 2 : i + 1;
    h = std::max(h, double(glm::distance(mesh.positions[mesh.indices[i]],
                                         mesh.positions[mesh.indices[next]])));
  }
  const glint::Bounds bounds = glint::boundsOf(scene);
  h /= bounds.radius;
  for (auto& material : scene.materials) {
    material = Material{};
    material.shading.ambient = 0;
  }
  Look look = plainLook(200, 200);
  look.noBackground = true;
  const glm::dvec3 L = glm::normalize(glm::dvec3(-0.5, 0.7, 1));
  auto renderer = referenceOf(scene, look);
  const auto image = renderer.draw();
  const auto& camera = renderer.stage().camera;
  const glm::dvec3 center = glm::transpose(camera.axes) * (bounds.center - camera.eye);
  int compared = 0;
  double worst = 0;
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 200; ++x) {
      const glm::dvec3 d =
          glm::normalize(glm::dvec3(((x + 0.5) / 100 - 1) * camera.halfHeight,
                                    (1 - (y + 0.5) / 100) * camera.halfHeight, -1));
      const double along = glm::dot(center, d);
      const double square =
          along * along - glm::dot(center, center) + bounds.radius * bounds.radius;
      if (square < 0) {
        EXPECT_EQ(pixel(image, x, y).a, 0) << x << "," << y;
        continue;
      }
      const glm::dvec3 N = ((along - std::sqrt(square)) * d - center) / bounds.radius;
      if (-glm::dot(N, d) < 0.3) continue;  // near the outline facets are seen edge on
      ++compared;
      worst = std::max(worst, std::abs(pixel(image, x, y).r - std::max(glm::dot(N, L), 0.0)));
    }
  EXPECT_GT(compared, 15000);
  EXPECT_LT(worst, h * h / 2);
  EXPECT_GT(worst, 1e-9);
}

TEST(ReferenceUsage, RefusesNumbersOfSamplesWithoutAPattern) {
  Scene scene = sceneOf({{rectangle({0, 0}, {1, 1}), Material{}}});
  Look look;
  look.antiAliasing = {glint::AntiAliasing::Mode::msaa, 6};
  EXPECT_EQ(test::messageOf([&] { draw(scene, look); }),
            "--anti-aliasing msaa:6: the reference draws msaa of 2, 4, 8 and 16 samples: give one "
            "of these, or ssaa:N");
}

}  // namespace glint::reference_shading_test
