#include "scene_models.h"

#include <algorithm>
#include <cmath>

#include "circle.h"
#include "glb.h"
#include "lathe.h"
#include "materials.h"
#include "mesh.h"

namespace glint::models {
namespace {

/// The quaternion x, y, z, w of a rotation by 2 k/n turns about X or Z.
glm::vec4 aboutX(int k, int n) {
  const glm::dvec2 half = onCircle(k, n);
  return {half.y, 0.0, 0.0, half.x};
}
glm::vec4 aboutZ(int k, int n) {
  const glm::dvec2 half = onCircle(k, n);
  return {0.0, 0.0, half.y, half.x};
}

json jsonOf(const glm::vec4& v) { return {v.x, v.y, v.z, v.w}; }

Mesh plainSphere(int around, int down) {
  Mesh mesh = sphere(around, down);
  mesh.texcoords.clear();
  return mesh;
}

/// A square centred at the origin, facing up.
Mesh floorMesh(double size, int pieces) {
  Mesh mesh;
  for (int row = 0; row <= pieces; ++row) {
    for (int column = 0; column <= pieces; ++column) {
      mesh.positions.emplace_back((double(column) / pieces - 0.5) * size, 0.0,
                                  (double(row) / pieces - 0.5) * size);
      mesh.normals.emplace_back(0.0, 1.0, 0.0);
    }
  }
  const auto index = [&](int row, int column) {
    return static_cast<std::uint32_t>(row * (pieces + 1) + column);
  };
  for (int row = 0; row < pieces; ++row) {
    for (int column = 0; column < pieces; ++column) {
      const auto a = index(row, column), b = index(row + 1, column);
      mesh.indices.insert(mesh.indices.end(), {a, b, b + 1, a, b + 1, a + 1});
    }
  }
  return mesh;
}

void addAnimation(GlbBuilder& builder, const std::string& name, const std::string& path,
                  const std::vector<int>& nodes, int times, int values) {
  json channels;
  for (const int node : nodes) {
    channels.push_back({{"sampler", 0}, {"target", {{"node", node}, {"path", path}}}});
  }
  builder.document["animations"] = {
      {{"name", name},
       {"samplers", {{{"input", times}, {"output", values}, {"interpolation", "LINEAR"}}}},
       {"channels", channels}}};
}

}  // namespace

std::string preview() {
  const double slant = std::sqrt(0.5);
  const glm::dvec2 diagonal(slant, slant);
  const double dish = 0.35, rim = 0.05, throat = 0.2;
  // Each circle touches the previous one: the rim touches the dish at 45 degrees, the ball the rim
  // at 60 degrees above the horizontal, the throat the ball at 45 degrees below it.
  const glm::dvec2 rimCenter(slant * (dish + rim), 0.0);
  const glm::dvec2 dishCenter = rimCenter + (dish + rim) * glm::dvec2(-slant, slant);
  const glm::dvec2 at60 = onCircle(60, 360);
  const double ball = rimCenter.x / at60.x + rim;
  const glm::dvec2 ballCenter(0.0, rimCenter.y - (ball - rim) * at60.y);
  const glm::dvec2 throatCenter =
      ballCenter + (ball + throat) * glm::dvec2(diagonal.x, -diagonal.y);
  const double baseTop = throatCenter.y - throat;
  const double bevel = 0.04, baseHeight = 0.16, baseRadius = 0.9;

  Profile body;
  body.arc(dishCenter, dish, -90, -45, 5);
  body.arc(rimCenter, rim, 135, 60, 5);
  body.arc(ballCenter, ball, 60, 15, 7);
  body.grooves(ballCenter, ball, 15, -15, 4, 0.03);
  body.arc(ballCenter, ball, -15, -45, 5);
  body.arc(throatCenter, throat, 135, 270, 9);
  Profile base;
  const double edge = baseRadius - bevel, bottom = baseTop - baseHeight;
  base.line({throatCenter.x, baseTop}, {edge, baseTop}, 4);
  base.arc({edge, baseTop - bevel}, bevel, 90, 0, 4);
  base.line({baseRadius, baseTop - bevel}, {baseRadius, bottom + bevel}, 1);
  base.arc({edge, bottom + bevel}, bevel, 0, -90, 4);
  base.line({edge, bottom}, {0.0, bottom}, 1);
  body.lift(-bottom);
  base.lift(-bottom);

  GlbBuilder builder;
  builder.document["materials"] = {material("Preview", {0.7, 0.15, 0.05}, 0.5, 60, 0),
                                   material("Base", {0.35, 0.35, 0.37}, 0.2, 20, 0)};
  const int bodyMesh = builder.addMesh("Preview", builder.primitive(lathe(body, 48), 0));
  const int baseMesh = builder.addMesh("Base", builder.primitive(lathe(base, 48), 1));
  const int bodyNode = builder.addNode({{"mesh", bodyMesh}, {"name", "Preview"}});
  const int baseNode = builder.addNode({{"mesh", baseMesh}, {"name", "Base"}});
  return builder.bytes({bodyNode, baseNode});
}

std::string chart() {
  const std::vector<std::string> metalness = {"0", "0.25", "0.5", "0.75", "1"};
  const std::vector<int> exponents = {5, 10, 20, 40, 80, 160, 320};
  const double distance = 2.3;
  GlbBuilder builder;
  const json primitive = builder.primitive(plainSphere(48, 24), 0);
  std::vector<int> nodes;
  for (std::size_t row = 0; row < metalness.size(); ++row) {
    for (std::size_t column = 0; column < exponents.size(); ++column) {
      const int exponent = exponents[column];
      const std::string name = "e" + std::to_string(exponent) + "-m" + metalness[row];
      json ofMaterial = primitive;
      ofMaterial["material"] = nodes.size();
      builder.document["materials"].push_back(
          material(name, {0.8, 0.3, 0.1}, 0.7, exponent, 0.25 * double(row)));
      const int mesh = builder.addMesh(name, ofMaterial);
      nodes.push_back(builder.addNode(
          {{"mesh", mesh},
           {"name", name},
           {"translation",
            {distance * (double(column) - 3.0), distance * (double(row) - 2.0), 0.0}}}));
    }
  }
  return builder.bytes(nodes);
}

std::string bend() {
  const double radius = 0.15, height = 2.0, bone = 0.5;
  const int joints = 4;
  Profile profile;
  profile.arc({0.0, height - radius}, radius, 90, 0, 6);
  profile.line({radius, height - radius}, {radius, radius}, 40);
  profile.arc({0.0, radius}, radius, 0, -90, 6);
  const Mesh mesh = lathe(profile, 24);

  // Up to the middle of each bone only its own joint has weight; from there the next one takes
  // over.
  std::vector<glm::u8vec4> holders;
  std::vector<glm::vec4> weights;
  for (const glm::vec3& p : mesh.positions) {
    const double place = std::clamp(p.y / bone - 0.5, 0.0, joints - 1.0);
    const int lower = std::min(static_cast<int>(place), joints - 2);
    const double upper = place - lower;
    holders.emplace_back(upper < 1.0 ? lower : 0, upper > 0.0 ? lower + 1 : 0, 0, 0);
    weights.emplace_back(1.0 - upper, upper, 0.0, 0.0);
  }

  GlbBuilder builder;
  builder.document["materials"] = {material("Rubber", {0.1, 0.25, 0.7}, 0.3, 30, 0)};
  json primitive = builder.primitive(mesh, 0);
  primitive["attributes"]["JOINTS_0"] = builder.addBytes(holders);
  primitive["attributes"]["WEIGHTS_0"] = builder.addVertices<4>(weights);
  const int meshIndex = builder.addMesh("Rod", primitive);
  const int rod = builder.addNode({{"mesh", meshIndex}, {"skin", 0}, {"name", "Rod"}});

  std::vector<int> nodes;
  std::vector<glm::mat4> toJoint;
  for (int i = 0; i < joints; ++i) {
    json node = {{"name", "Joint " + std::to_string(i)}};
    if (i > 0) node["translation"] = {0.0, bone, 0.0};
    if (i + 1 < joints) node["children"] = {rod + i + 2};
    nodes.push_back(builder.addNode(node));
    glm::mat4 matrix(1.0f);
    matrix[3].y = static_cast<float>(-bone * i);
    toJoint.push_back(matrix);
  }
  builder.document["skins"] = {{{"name", "Rod"},
                                {"joints", nodes},
                                {"skeleton", nodes[0]},
                                {"inverseBindMatrices", builder.addMatrices(toJoint)}}};
  const int times = builder.addKeys(std::vector<float>{0, 1, 2, 3, 4});
  const glm::vec4 straight = aboutZ(0, 24), right = aboutZ(-1, 24), left = aboutZ(1, 24);
  const int turns =
      builder.addKeys(std::vector<glm::vec4>{straight, right, straight, left, straight});
  addAnimation(builder, "Bend", "rotation", {nodes[1], nodes[2], nodes[3]}, times, turns);
  return builder.bytes({rod, nodes[0]});
}

std::string morph() {
  const Mesh mesh = plainSphere(48, 24);
  std::vector<glm::vec3> toTall, toTallNormal, toCube, toCubeNormal;
  for (const glm::vec3& position : mesh.positions) {
    const glm::dvec3 p(position);
    const glm::dvec3 axes(0.6, 1.5, 0.6);
    toTall.emplace_back(axes * p - p);
    toTallNormal.emplace_back(glm::normalize(p / axes) - p);
    // x^4 + y^4 + z^4 = 1/2, whose normal is along the third powers.
    const glm::dvec3 square = p * p;
    const double size = std::sqrt(std::sqrt(2.0 * glm::dot(square, square)));
    toCube.emplace_back(p / size - p);
    toCubeNormal.emplace_back(glm::normalize(square * p) - p);
  }
  GlbBuilder builder;
  builder.document["materials"] = {material("Clay", {0.6, 0.35, 0.1}, 0.4, 30, 0)};
  json primitive = builder.primitive(mesh, 0);
  const auto target = [&](const auto& positions, const auto& normals) -> json {
    return {{"POSITION", builder.addVertices<3>(positions)},
            {"NORMAL", builder.addVertices<3>(normals)}};
  };
  primitive["targets"] = {target(toTall, toTallNormal), target(toCube, toCubeNormal)};
  const int meshIndex = builder.addMesh("Ball", primitive);
  json& entry = builder.document["meshes"][static_cast<std::size_t>(meshIndex)];
  entry["weights"] = {0, 0};
  entry["extras"] = {{"targetNames", {"Tall", "Cube"}}};
  const int node = builder.addNode({{"mesh", meshIndex}, {"name", "Ball"}});
  const int times = builder.addKeys(std::vector<float>{0, 1, 2, 3});
  const int weights = builder.addKeys(std::vector<float>{0, 0, 1, 0, 0, 1, 0, 0});
  addAnimation(builder, "Morph", "weights", {node}, times, weights);
  return builder.bytes({node});
}

std::string lights() {
  GlbBuilder builder;
  json& document = builder.document;
  document["materials"] = {material("Floor", {0.6, 0.6, 0.6}, 0.1, 20, 0),
                           material("Ball", {0.7, 0.7, 0.7}, 0.5, 50, 0)};
  const int floor = builder.addMesh("Floor", builder.primitive(floorMesh(4.0, 24), 0));
  const int ball = builder.addMesh("Ball", builder.primitive(plainSphere(48, 24), 1));
  std::vector<int> nodes = {builder.addNode({{"mesh", floor}, {"name", "Floor"}})};
  const double radius = 0.4;
  for (const double x : {-1.2, 0.0, 1.2}) {
    nodes.push_back(builder.addNode({{"mesh", ball},
                                     {"name", "Ball"},
                                     {"translation", {x, radius, 0.0}},
                                     {"scale", {radius, radius, radius}}}));
  }

  const char* extension = "KHR_lights_punctual";
  document["extensionsUsed"] = {extension};
  document["extensions"][extension]["lights"] = {
      {{"name", "Sky"}, {"type", "directional"}, {"color", {1, 1, 1}}, {"intensity", 0.3}},
      {{"name", "Lamp"},
       {"type", "point"},
       {"color", {1, 0.5, 0.2}},
       {"intensity", 0.6},
       {"range", 4}},
      {{"name", "Spot"},
       {"type", "spot"},
       {"color", {0.3, 0.5, 1}},
       {"intensity", 5},
       {"spot", {{"innerConeAngle", 0.2}, {"outerConeAngle", 0.35}}}}};
  const auto addLight = [&](int light, const json& place, const glm::vec4& turn) {
    nodes.push_back(
        builder.addNode({{"name", document["extensions"][extension]["lights"][light]["name"]},
                         {"translation", place},
                         {"rotation", jsonOf(turn)},
                         {"extensions", {{extension, {{"light", light}}}}}}));
  };
  // Lights shine along -Z: rotated by -60 and -75 degrees about X, they point down and slightly
  // back.
  addLight(0, {0.0, 3.0, 0.0}, aboutX(-2, 24));
  addLight(1, {-1.5, 0.9, 0.7}, aboutX(0, 24));
  addLight(2, {1.2, 2.0, 0.6}, aboutX(-5, 48));
  return builder.bytes(nodes);
}

}  // namespace glint::models
