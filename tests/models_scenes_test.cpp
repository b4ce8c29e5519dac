// The files in models/ with several meshes or with motion, compared with formulas that the program
// that makes them does not use. Moving ones are read by the project's reader.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "glint/gltf/scene_file.h"
#include "models_file.h"

namespace models_scenes_test {

using namespace shipped;

glint::Scene atTime(const std::string& name, double seconds) {
  glint::PoseRequest request;
  request.time = seconds;
  return glint::loadGltf(folder / name, request);
}

/// The trefoil on the torus of radii 0.6 and 0.26.
glm::dvec3 knot(double t) {
  const double distance = 0.6 + 0.26 * std::cos(3 * t);
  return {distance * std::cos(2 * t), 0.26 * std::sin(3 * t), distance * std::sin(2 * t)};
}

TEST(TorusKnot, IsATubeAboutItsCurve) {
  const Model model = load("torus-knot.glb");
  EXPECT_EQ(model.triangleCount(), 6144u);
  const int samples = 1536;
  for (std::size_t i = 0; i < model.positions.size(); ++i) {
    const glm::dvec3 p = model.positions[i];
    double best = 0;
    for (int k = 1; k < samples; ++k) {
      const double t = 2 * std::numbers::pi * k / samples;
      if (glm::distance(knot(t), p) < glm::distance(knot(best), p)) best = t;
    }
    // Golden-section search between the two neighbours; the distance is flat at its minimum.
    double low = best - 2 * std::numbers::pi / samples, high = best + (best - low);
    for (int k = 0; k < 60; ++k) {
      const double a = high - (high - low) / std::numbers::phi;
      const double b = low + (high - low) / std::numbers::phi;
      if (glm::distance(knot(a), p) < glm::distance(knot(b), p)) {
        high = b;
      } else {
        low = a;
      }
    }
    const glm::dvec3 nearest = knot((low + high) / 2);
    ASSERT_NEAR(glm::distance(nearest, p), 0.14, rounding);
    // The minimum is found only to the square root of the precision, about 1e-8 of the length.
    ASSERT_LT(glm::distance(model.normals[i], (p - nearest) / 0.14), 1e-6);
  }
  EXPECT_EQ(openEdges(model), 0u);
  double length = 0;
  for (int k = 0; k < samples; ++k) {
    length += glm::distance(knot(2 * std::numbers::pi * k / samples),
                            knot(2 * std::numbers::pi * (k + 1) / samples));
  }
  // A tube's volume is its cross-section's area times its length. A regular 16-gon has 0.9745 of
  // the circle's area; the 192 chords along the tube lose far less than a hundredth.
  const double exact = std::numbers::pi * 0.14 * 0.14 * length;
  EXPECT_NEAR(volume(model) / exact, 0.9745, 0.01);
}

TEST(Preview, StandsOnTheFloorWithHollowAndRoundParts) {
  const glint::Scene scene = glint::loadGltf(folder / "preview.glb");
  ASSERT_EQ(scene.meshes.size(), 2u);
  EXPECT_EQ(scene.materials[0].name, "Preview");
  EXPECT_EQ(scene.materials[1].name, "Base");
  double lowest = 1, inward = 0, flat = 0;
  for (const glint::Mesh& mesh : scene.meshes) {
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      const glm::dvec3 p = mesh.positions[i], n = mesh.normals[i];
      lowest = std::min(lowest, p.y);
      const double outward = glm::dot(glm::dvec2(p.x, p.z), glm::dvec2(n.x, n.z));
      inward += outward < -0.01 && n.y > 0.5;
      flat += n.y > 1 - 1e-9;
    }
  }
  EXPECT_NEAR(lowest, 0, 1e-7);
  EXPECT_GE(inward, 48);  // the dish
  EXPECT_GE(flat, 48 * 4);
  // The body ends where the base begins: the only open edges are a ring of 48.
  EXPECT_EQ(openEdges(load("preview.glb")), 48u);
  expectFacesFollowNormals(load("preview.glb"));
}

TEST(Chart, NamesSayWhatTheMaterialsAre) {
  const Model model = load("chart.glb");
  const json& document = model.document;
  ASSERT_EQ(document["nodes"].size(), 35u);
  std::set<std::string> names;
  std::set<int> positions;
  for (const json& node : document["nodes"]) {
    const json& primitive = document["meshes"][node["mesh"].get<int>()]["primitives"][0];
    positions.insert(primitive["attributes"]["POSITION"].get<int>());
    const json& material = document["materials"][primitive["material"].get<int>()];
    const std::string name = material["name"];
    names.insert(name);
    const auto split = name.find("-m");
    const json& phong = material["extras"]["glint"];
    EXPECT_EQ(phong["exponent"], std::stod(name.substr(1, split - 1))) << name;
    EXPECT_EQ(phong["metalness"], std::stod(name.substr(split + 2))) << name;
    // To the right the exponent doubles every 2.3 units, upwards the metalness increases by 1/4.
    EXPECT_NEAR(node["translation"][0], 2.3 * std::log2(phong["exponent"].get<double>() / 40),
                1e-9);
    EXPECT_NEAR(node["translation"][1], 2.3 * (4 * phong["metalness"].get<double>() - 2), 1e-9);
  }
  EXPECT_EQ(names.size(), 35u);
  EXPECT_EQ(positions.size(), 1u);
}

TEST(Bend, TipGoesWhereItsJointsTakeIt) {
  const Model model = load("bend.glb");
  EXPECT_EQ(model.document["skins"][0]["joints"].size(), 4u);
  EXPECT_EQ(openEdges(model), 0u);
  std::size_t tip = 0;
  for (std::size_t i = 0; i < model.positions.size(); ++i) {
    if (model.positions[i].y > model.positions[tip].y) tip = i;
  }
  EXPECT_EQ(model.positions[tip], glm::dvec3(0, 2, 0));
  // Four bones of 1/2, each rotated 30 degrees further than the one below; by half of that at half
  // time, because a rotation about one axis is uniform.
  for (const double time : {0.0, 0.5, 1.0, 2.0, 3.0, 4.0}) {
    SCOPED_TRACE(time);
    const double turn = std::numbers::pi / 6 * (time <= 1 ? time : time == 3 ? -1.0 : 0.0);
    glm::dvec3 expected(0);
    for (int bone = 0; bone < 4; ++bone) {
      expected += 0.5 * glm::dvec3(std::sin(bone * turn), std::cos(bone * turn), 0);
    }
    const glint::Scene scene = atTime("bend.glb", time);
    EXPECT_TRUE(scene.warnings.empty());
    const glint::Mesh& mesh = scene.meshes.at(0);
    const glm::dvec3 place =
        glm::dvec3(scene.instances[0].world * glm::dvec4(glm::dvec3(mesh.positions[tip]), 1)) +
        mesh.origin;
    EXPECT_LT(glm::distance(place, expected), 1e-6);
    const glm::dvec3 normal(mesh.normals[tip]);
    EXPECT_LT(glm::distance(normal, {std::sin(3 * turn), std::cos(3 * turn), 0}), 1e-6);
  }
}

TEST(Morph, TargetsAreAnEllipsoidAndACube) {
  const glint::Scene ball = atTime("morph.glb", 0), tall = atTime("morph.glb", 1),
                     cube = atTime("morph.glb", 2), again = atTime("morph.glb", 3);
  EXPECT_EQ(again.meshes[0].positions, ball.meshes[0].positions);
  for (std::size_t i = 0; i < ball.meshes[0].positions.size(); ++i) {
    ASSERT_NEAR(glm::length(glm::dvec3(ball.meshes[0].positions[i])), 1, 1e-7);
    const glm::dvec3 p = tall.meshes[0].positions[i];
    const glm::dvec3 gradient(p.x / 0.36, p.y / 2.25, p.z / 0.36);
    // A few roundings of coordinates up to 1.5, divided by the smallest axis of 0.6.
    ASSERT_NEAR(glm::dot(p, gradient), 1, 1e-6);
    ASSERT_LT(glm::distance(glm::dvec3(tall.meshes[0].normals[i]), glm::normalize(gradient)), 1e-6);
    const glm::dvec3 q = cube.meshes[0].positions[i];
    const glm::dvec3 third = q * q * q;
    ASSERT_NEAR(glm::dot(q, third), 0.5, 1e-6);
    ASSERT_LT(glm::distance(glm::dvec3(cube.meshes[0].normals[i]), glm::normalize(third)), 1e-6);
  }
}

TEST(LightsModel, HasEachTypeOnce) {
  const glint::Scene scene = glint::loadGltf(folder / "lights.glb");
  EXPECT_TRUE(scene.warnings.empty());
  ASSERT_EQ(scene.lights.size(), 3u);
  using Type = glint::FileLight::Type;
  EXPECT_EQ(scene.lights[0].type, Type::directional);
  EXPECT_EQ(scene.lights[1].type, Type::point);
  EXPECT_EQ(scene.lights[2].type, Type::spot);
  // The spot's axis meets the ball: its distance from the ball's centre is below the radius.
  const glint::FileLight& spot = scene.lights[2];
  const glm::dvec3 toBall = glm::dvec3(1.2, 0.4, 0) - spot.position;
  EXPECT_LT(glm::length(glm::cross(toBall, spot.direction)), 0.4);
  EXPECT_GT(glm::dot(toBall, spot.direction), 0);
  EXPECT_LT(scene.lights[0].direction.y, -0.5);
}

TEST(Models, ScenesAreSmall) {
  for (const char* name : {"torus-knot", "preview", "chart", "bend", "morph", "lights"}) {
    EXPECT_LT(std::filesystem::file_size(folder / (std::string(name) + ".glb")), 150'000u) << name;
  }
}

}  // namespace models_scenes_test
