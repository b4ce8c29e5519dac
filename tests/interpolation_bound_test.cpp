// The error of flat and gouraud shading compared with its bound: random triangles under lights of
// all kinds, searched for the point with the largest difference between the interpolated sum of
// their corners and the sum at the point, both by the reference's formulas in double.

#include "glint/budget/interpolation_bound.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <random>

#include "glint/options/parameters.h"
#include "glint/reference/renderer.h"
#include "glint/shading/sum.h"
#include "random.h"
#include "scenes.h"

namespace glint::test::interpolation_bound_test {

int draws(int usual) { return test::drawsOf("GLINT_BOUND_DRAWS", usual); }

struct Random : test::Random {
  using test::Random::Random;
  double normal() { return std::normal_distribution<double>()(engine_); }
  glm::dvec3 vector() { return {normal(), normal(), normal()}; }
  glm::dvec3 direction() { return glm::normalize(vector()); }
};

struct Draw {
  Scene scene;
  Look look;
};

// The same triangle under a transform that scales unevenly and may mirror.
void placeUnevenly(Scene& scene, Random& r) {
  const auto scale = [&] { return (r.coin() ? -1 : 1) * (0.5 + r.unit()); };
  const glm::dmat4 world = test::rotation(r.unit()) * test::scaling({scale(), scale(), scale()});
  const glm::dmat3 linear(world);
  Mesh& mesh = scene.meshes.front();
  for (glm::vec3& x : mesh.positions) x = glm::vec3(glm::inverse(linear) * glm::dvec3(x));
  for (glm::vec3& n : mesh.normals)
    n = glm::vec3(glm::normalize(glm::transpose(linear) * glm::dvec3(n)));
  if (glm::determinant(linear) < 0) std::swap(mesh.indices[1], mesh.indices[2]);
  scene.instances.front().world = world;
}

enum class Kind { directional, point, falloff, spot, any };

// A triangle of about unit size seen from somewhere, with normals near the face's or not, under
// lights that tend to graze it, to be mirrored to the eye, or to be near it.
Draw randomDraw(Random& r, Kind kind, Shading program) {
  Draw d;
  Mesh mesh;
  const double thin = r.coin() ? 1 : r.log(0.01, 1);
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {float(r.unit()), float(thin * (0.3 + r.unit())), 0}};
  const glm::dmat3 turn(test::rotation(7 * r.unit()));
  for (glm::vec3& x : mesh.positions) x = glm::vec3(turn * glm::dvec3(x));
  const glm::dvec3 face = turn * glm::dvec3(0, 0, 1);
  const double apart = r.log(1e-3, 0.7);
  const glm::dvec3 middle = glm::normalize(face + (r.coin() ? 0.5 : 0.0) * r.unit() * r.vector());
  for (int j = 0; j < 3; ++j)
    mesh.normals.emplace_back(
        program == Shading::flat ? face : glm::normalize(middle + apart * r.vector()));
  mesh.indices = {0, 1, 2};
  Material m = test::materialOf(0, 0, 0, r.log(0.2, 300), r.unit(), r.color());
  if (r.below(5) == 0) m.shading.exponent = 2 * r.unit();
  const int terms = r.below(3);
  if (terms != 0) m.shading.diffuse = 1;
  if (terms != 1) m.shading.specular = 1;
  m.doubleSided = r.below(4) == 0;
  d.scene = test::sceneOf(mesh, m);
  const glm::dvec3 toEye = glm::normalize(middle + r.unit() * r.vector());
  d.look = test::parallelLook(toEye);
  d.look.cameraOrthographic = r.coin();
  if (!d.look.cameraOrthographic)
    d.look.cameraPosition = glm::dvec3(mesh.positions[0]) + r.log(0.2, 30) * toEye;
  d.look.viewer = r.below(3) == 0 ? Viewer::infinite : Viewer::local;
  d.look.light.emplace();
  for (int i = r.below(4) == 0 ? 2 : 0; i >= 0; --i) {
    glm::dvec3 to = r.direction();
    if (r.coin()) to = 2 * glm::dot(middle, toEye) * middle - toEye;  // mirrored
    if (r.below(3) == 0) to -= glm::dot(to, middle) * middle;         // grazing
    to = glm::normalize(to + r.log(1e-3, 1) * r.vector());
    Light light = test::directional(to, r.coin() ? glm::dvec3(1) : r.color());
    const Kind now = kind == Kind::any ? Kind(r.below(4)) : kind;
    if (now == Kind::directional && r.below(4) == 0) light.type = Light::Type::camera;
    if (now != Kind::directional) {
      light.type = now == Kind::spot ? Light::Type::spot : Light::Type::point;
      light.position = glm::dvec3(mesh.positions[std::size_t(r.below(3))]) + r.log(0.3, 100) * to;
      light.fallsOff = now == Kind::falloff || (now == Kind::spot && r.below(3) == 0);
      if (light.fallsOff && r.coin())
        light.range =
            r.coin() ? r.log(0.5, 100) : (0.8 + 0.6 * r.unit()) * glm::length(light.position);
      light.outerAngle = r.log(0.5, 89);
      light.innerAngle = light.outerAngle * 0.99 * r.unit();
      const double aside = light.outerAngle * test::degrees * 2 * r.unit();
      light.direction = glm::normalize(-to + std::tan(std::min(aside, 1.5)) * r.direction());
    }
    d.look.light->push_back(light);
  }
  if (r.below(3) == 0) placeUnevenly(d.scene, r);
  return d;
}

// The same with everything changed slightly.
Draw nudged(const Draw& from, double step, Random& r) {
  Draw d = from;
  Mesh& mesh = d.scene.meshes.front();
  const auto move = [&](auto v) { return decltype(v)(glm::dvec3(v) + step * r.vector()); };
  const auto grow = [&](double& x, double most) {
    x = std::min(x * std::exp(step * r.normal()), most);
  };
  const bool flat = glm::length(mesh.normals[0] - mesh.normals[1]) < 1e-6f &&
                    glm::length(mesh.normals[0] - mesh.normals[2]) < 1e-6f;
  for (glm::vec3& x : mesh.positions) x = move(x);
  const glm::vec3 corner = mesh.positions[mesh.indices[0]];
  const glm::vec3 face = glm::cross(mesh.positions[mesh.indices[1]] - corner,
                                    mesh.positions[mesh.indices[2]] - corner);
  for (glm::vec3& n : mesh.normals) n = glm::normalize(flat ? face : move(n));
  grow(d.scene.materials.front().shading.exponent, 1e4);
  if (d.look.cameraPosition) {
    const glm::dvec3 at(mesh.positions[0]), way = *d.look.cameraPosition - at;
    d.look.cameraPosition = at + std::exp(step * r.normal()) * move(way);
  }
  for (Light& light : *d.look.light) {
    light.position =
        glm::dvec3(mesh.positions[0]) +
        std::exp(step * r.normal()) * move(light.position - glm::dvec3(mesh.positions[0]));
    light.direction = glm::normalize(move(light.direction));
    grow(light.outerAngle, 89);
    grow(light.innerAngle, 0.99 * light.outerAngle);
    grow(light.range, 1e3);
  }
  return d;
}

// The largest difference between what the program interpolates and the sum at the point, over all
// triangles, for the visible side.
double worstOf(const Draw& d, Shading program, Random& r, int steps) {
  const ReferenceRenderer reference(d.scene, {}, boundsOf(d.scene), d.look, 1);
  const reference::Stage& stage = reference.stage();
  const reference::Item& item = stage.items.front();
  const reference::Vertices& vertices = stage.vertices[item.vertices];
  const glm::dvec3 C(item.color);
  const std::vector<std::uint32_t>& indices = item.mesh->indices;
  double worst = 0;
  const auto hunt = [&](std::size_t first, double side) {
    const auto light = [&](const glm::dvec3& position, const glm::dvec3& normal) {
      const reference::Terms t = reference::lightAt(stage.frame, item.surface, item.surface.numbers,
                                                    position, side * glm::normalize(normal));
      return sumColor({t.matte, t.specular}, C, item.surface.numbers.metalness);
    };
    const auto place = [&](const glm::dvec3& b, const std::vector<glm::dvec3>& of) {
      return b.x * of[indices[first]] + b.y * of[indices[first + 1]] + b.z * of[indices[first + 2]];
    };
    std::array<glm::dvec3, 3> corners;
    for (std::size_t j = 0; j < 3; ++j)
      corners[j] = light(vertices.eye[indices[first + j]], vertices.normals[indices[first + j]]);
    const glm::dvec3 middle(1 / 3.0);
    const glm::dvec3 flat = light(place(middle, vertices.eye), place(middle, vertices.normals));
    double here = 0;
    glm::dvec3 best = middle;
    const auto attempt = [&](const glm::dvec3& b) {
      if (!(std::min({b.x, b.y, b.z}) >= 0)) return;
      const glm::dvec3 carried =
          program == Shading::flat ? flat : b.x * corners[0] + b.y * corners[1] + b.z * corners[2];
      const glm::dvec3 off =
          glm::abs(carried - light(place(b, vertices.eye), place(b, vertices.normals)));
      const double error = std::max({off.x, off.y, off.z});
      if (error > here) here = error, best = b;
    };
    for (int i = 0; i <= steps; ++i)
      for (int j = 0; i + j <= steps; ++j) attempt(glm::dvec3(i, j, steps - i - j) / double(steps));
    if (here > 0.7 * worst) {
      double way = 1.0 / steps;
      for (int i = 0; i < 60; ++i, way *= 0.9) {
        const double x = way * r.normal(), y = way * r.normal();
        attempt(best + glm::dvec3(x, y, -x - y));
      }
    }
    worst = std::max(worst, here);
  };
  for (std::size_t first = 0; first + 2 < indices.size(); first += 3) {
    const glm::dvec3 a = vertices.eye[indices[first]];
    const glm::dvec3 face =
        glm::cross(vertices.eye[indices[first + 1]] - a, vertices.eye[indices[first + 2]] - a);
    const double facing = glm::dot(face, stage.camera.orthographic ? glm::dvec3(0, 0, 1) : -a);
    const bool front = item.mirrored ? facing < 0 : facing > 0;
    if (front || item.surface.twoSided) hunt(first, front ? 1 : -1);
  }
  return worst;
}

double boundOf(const Draw& d, Shading program) {
  const Material& material = d.scene.materials.front();
  const Mesh& mesh = d.scene.meshes.front();
  const Camera camera = cameraFor(d.scene, boundsOf(d.scene), d.look);
  const glm::dmat4& world = d.scene.instances[0].world;
  const Variant v = variantFor(mesh, material, world, d.look, camera.orthographic);
  const std::vector<Light> lights = lightsOf(d.look);
  return interpolationBound({d.scene, mesh, world, material, d.look, camera, lights, v}, program);
}

// The ratio of the bound to the error found.
class Looseness {
 public:
  void add(double bound, double worst) {
    if (worst > 1e-6) of_.push_back(bound / worst);
  }
  std::size_t count() const { return of_.size(); }
  double at(double share) {
    std::sort(of_.begin(), of_.end());
    return of_.at(std::size_t(share * double(of_.size() - 1)));
  }
  void print() {
    std::printf("bound / found of %zu: least %.3f, 10 %% %.2f, half %.2f, 90 %% %.3g, most %.3g\n",
                count(), at(0), at(0.1), at(0.5), at(0.9), at(1));
  }

 private:
  std::vector<double> of_;
};

std::string describe(const Draw& d) {
  const ShadingParameters& m = d.scene.materials.front().shading;
  return saveLook(d.look) + " exponent " + std::to_string(m.exponent) + " diffuse " +
         std::to_string(m.diffuse) + " specular " + std::to_string(m.specular);
}

// No error found is above the bound; a tenth of the triangles come nearer to it than `nearly`.
void attack(Kind kind, Shading program, unsigned seed, double nearly) {
  Random r(seed);
  Looseness looseness;
  const int count = draws(1500);
  for (int i = 0; i < count; ++i) {
    const Draw d = randomDraw(r, kind, program);
    const double bound = boundOf(d, program), worst = worstOf(d, program, r, 18);
    ASSERT_LE(worst, bound + 1e-12) << i << ": " << describe(d);
    looseness.add(bound, worst);
  }
  looseness.print();
  EXPECT_GT(looseness.count(), std::size_t(count / 4));
  EXPECT_LT(looseness.at(0.1), nearly);
}

TEST(InterpolationBound, OfGouraudUnderDirectionalLights) {
  attack(Kind::directional, Shading::gouraud, 41, 1.5);
}
TEST(InterpolationBound, OfGouraudUnderPointLights) {
  attack(Kind::point, Shading::gouraud, 42, 2);
}
TEST(InterpolationBound, OfGouraudUnderLightsThatFallOff) {
  attack(Kind::falloff, Shading::gouraud, 43, 4);
}
TEST(InterpolationBound, OfGouraudUnderSpots) { attack(Kind::spot, Shading::gouraud, 44, 1.7); }
TEST(InterpolationBound, OfGouraudUnderAnyLights) { attack(Kind::any, Shading::gouraud, 45, 1.7); }
TEST(InterpolationBound, OfFlatUnderAnyLights) { attack(Kind::any, Shading::flat, 46, 2); }

// Climbs from random draws to where the error is closest to the bound.
void hunt(Kind kind, Shading program, unsigned seed, double nearly) {
  Random r(seed);
  double nearest = 0, nearestSmall = 0;
  for (int i = 0; i < draws(400) / 10; ++i) {
    Draw best = randomDraw(r, kind, program);
    double most = 0;
    for (int step = 0; step < 120; ++step) {
      const Draw d = step == 0 ? best : nudged(best, 0.2 * std::pow(0.96, step), r);
      const double bound = boundOf(d, program), worst = worstOf(d, program, r, 12);
      ASSERT_LE(worst, bound + 1e-12) << i << ": " << describe(d);
      // Half of them among small differences, which are dominated by the derivatives.
      const bool counts = i % 2 == 0 || worst < 0.03;
      if (counts && worst > 1e-5 && worst >= most * bound && bound < 1e6)
        most = worst / bound, best = d;
    }
    nearest = std::max(nearest, most);
    if (i % 2 == 1) nearestSmall = std::max(nearestSmall, most);
  }
  std::printf("at most %.4f of the bound, %.4f of small ones\n", nearest, nearestSmall);
  EXPECT_GT(nearest, nearly);
}

TEST(InterpolationBound, HuntedUnderDirectionalLights) {
  hunt(Kind::directional, Shading::gouraud, 51, 0.9);
}
TEST(InterpolationBound, HuntedUnderPointLights) { hunt(Kind::point, Shading::gouraud, 52, 0.9); }
TEST(InterpolationBound, HuntedUnderLightsThatFallOff) {
  hunt(Kind::falloff, Shading::gouraud, 53, 0.7);
}
TEST(InterpolationBound, HuntedUnderSpots) { hunt(Kind::spot, Shading::gouraud, 54, 0.9); }
TEST(InterpolationBound, HuntedOfFlat) { hunt(Kind::any, Shading::flat, 55, 0.7); }

// Over a whole sphere, where the highlight and the terminator of every light are visible, the bound
// is within a small factor of the error found.
TEST(InterpolationBound, OfSpheresIsNear) {
  Random r(47);
  for (const Kind kind : {Kind::directional, Kind::point, Kind::falloff, Kind::spot}) {
    Looseness looseness;
    for (int i = 0; i < draws(200) / 4; ++i) {
      const int around = 12 + r.below(40);
      Draw d = randomDraw(r, kind, Shading::gouraud);
      Material m = d.scene.materials.front();
      m.doubleSided = false;
      if (m.shading.specular > 0) m.shading.exponent = r.log(2, 40);
      d.scene = test::sceneOf(test::sphere(around, around / 2), m);
      const glm::dvec3 toEye = r.direction();
      d.look.cameraPosition = r.log(3, 30) * toEye;
      d.look.cameraFocalPoint = glm::dvec3(0.0);
      for (Light& light : *d.look.light) {
        light.position = r.log(2.5, 30) * glm::normalize(toEye + 0.7 * r.vector());
        light.range = 0;
        if (light.type == Light::Type::spot) light.direction = -light.position;
        if (light.type == Light::Type::directional) light.direction = toEye + 0.7 * r.vector();
      }
      const double bound = boundOf(d, Shading::gouraud);
      const double worst = worstOf(d, Shading::gouraud, r, 3);
      ASSERT_LE(worst, bound + 1e-12) << i << ": " << describe(d);
      looseness.add(bound, worst);
    }
    looseness.print();
    EXPECT_LT(looseness.at(0.5), 3) << int(kind);
  }
}

// Where nothing changes, no light arrives, or nothing is known.
TEST(InterpolationBound, OfPlainCases) {
  const Material matte = test::materialOf(0, 1, 0, 20), shiny = test::materialOf(0, 1, 1, 20);
  Draw d{test::sceneOf(test::quad(), shiny), test::parallelLook()};
  d.look.light = {test::directional({0, 0.6, 0.8})};
  EXPECT_LT(boundOf(d, Shading::flat), 1e-5);
  EXPECT_LT(boundOf(d, Shading::gouraud), 1e-5);
  // From behind.
  d.look.light = {test::directional({0, 0.6, -0.8})};
  EXPECT_EQ(boundOf(d, Shading::gouraud), 0);
  d.scene.materials[0].doubleSided = true;
  EXPECT_GT(boundOf(d, Shading::gouraud), 0);
  // A lamp over the middle of the square, which is far from linear.
  Light lamp = test::directional({0, 0, 0});
  lamp.type = Light::Type::point;
  lamp.position = {0, 0, 1};
  d.scene.materials[0] = matte;
  d.look.light = {lamp};
  EXPECT_GT(boundOf(d, Shading::gouraud), 0.3);
  EXPECT_LE(boundOf(d, Shading::gouraud), 1.0001);
  EXPECT_GT(boundOf(d, Shading::flat), 0.3);
  lamp.fallsOff = true;
  lamp.position = {0, 0, 30};
  d.look.light = {lamp};
  EXPECT_LT(boundOf(d, Shading::gouraud), 1e-4);
  lamp.range = 20;
  d.look.light = {lamp};
  EXPECT_EQ(boundOf(d, Shading::gouraud), 0);
  lamp.range = 0;
  lamp.position = {0.5, 0.5, 0};
  d.look.light = {lamp};
  EXPECT_EQ(boundOf(d, Shading::gouraud), std::numeric_limits<double>::infinity());
  // A cone that misses the square, one that contains it, and one whose edge crosses it.
  Light spot = lamp;
  spot.type = Light::Type::spot;
  spot.fallsOff = false;
  spot.position = {0, 0, 10};
  spot.direction = {1, 0, 0};
  spot.innerAngle = 30, spot.outerAngle = 40;
  d.look.light = {spot};
  EXPECT_EQ(boundOf(d, Shading::gouraud), 0);
  spot.direction = {0, 0, -1};
  d.look.light = {spot};
  const double inside = boundOf(d, Shading::gouraud);
  EXPECT_GT(inside, 0);
  spot.innerAngle = 1, spot.outerAngle = 5;
  d.look.light = {spot};
  EXPECT_GT(boundOf(d, Shading::gouraud), 3 * inside);
}

// Corners that a lamp just grazes, before and behind, with normals in between that lean to the
// other side of it: there the gate turns off the highlight that all three have, or turns one on.
TEST(InterpolationBound, CountsGatesThatTurnBetweenTheCorners) {
  for (const double side : {1.0, -1.0}) {
    Mesh mesh;
    for (int j = 0; j < 3; ++j) {
      const double angle = 120 * j * test::degrees;
      const glm::dvec3 place(0.1 * std::cos(angle), 0.1 * std::sin(angle), 0);
      const glm::dvec3 toLight = glm::normalize(glm::dvec3(0, 0, 1) - place);
      glm::dvec3 n(1, 0, 0.03 * side * (j == 0 ? 1 : -1));
      n -= (glm::dot(n, toLight) - 1e-5 * side) * toLight;
      mesh.positions.emplace_back(place);
      mesh.normals.emplace_back(glm::normalize(n));
    }
    mesh.indices = {0, 2, 1};
    const Material m = test::materialOf(0, 0, 1, 2);
    Draw d{test::sceneOf(mesh, m), test::parallelLook({0, 0, -1})};
    Light lamp;
    lamp.type = Light::Type::point;
    lamp.position = {0, 0, 1};
    d.look.light = {lamp};
    Random r(48);
    const double worst = worstOf(d, Shading::gouraud, r, 18);
    EXPECT_GT(worst, 0.8);
    EXPECT_LE(worst, boundOf(d, Shading::gouraud));
  }
}

// Only phong uses a normal map.
TEST(InterpolationBound, IsInfiniteWithNormalMaps) {
  Mesh mesh = test::quad();
  mesh.tangents.assign(4, {1, 0, 0, 1});
  mesh.texcoords = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  Material m = test::materialOf(1, 1, 0, 20);
  m.normalTexture.emplace();
  Draw d{test::sceneOf(mesh, m), test::parallelLook()};
  d.look.light = {test::directional({0, 0.6, 0.8})};
  for (const Shading program : {Shading::flat, Shading::gouraud})
    EXPECT_EQ(boundOf(d, program), std::numeric_limits<double>::infinity());
}

}  // namespace glint::test::interpolation_bound_test
