// Animations: keys and their interpolation, what they move, and errors in them.
#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "files.h"
#include "gltf_sample.h"

namespace gltf_animation_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using Json = Sample::Json;

/// One animation with one channel that moves node 0.
void animate(Sample& sample, const std::string& path, const std::string& interpolation,
             const std::vector<float>& times, const std::string& type,
             const std::vector<float>& values) {
  Json sampler = {{"input", sample.accessor<float>("SCALAR", times)},
                  {"output", sample.accessor<float>(type, values)}};
  if (!interpolation.empty()) sampler["interpolation"] = interpolation;
  sample.add("animations",
             {{"samplers", {sampler}},
              {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", path}}}}}}});
}

glint::Scene at(Sample& sample, double time, const std::string& animation = {}) {
  return glint::loadGltf(sample.writeGltf(), {time, animation});
}

double xAt(Sample& sample, double time) { return at(sample, time).instances.at(0).world[3].x; }

TEST(GltfAnimation, TranslationIsLinearBetweenKeysAndHeldOutside) {
  Sample sample;
  sample.triangle();
  sample.json["nodes"][0]["translation"] = {-7, 0, 0};
  animate(sample, "translation", "", {1, 2, 4}, "VEC3", {0, 0, 0, 10, 0, 0, 30, 0, 0});
  EXPECT_EQ(sample.load().instances.at(0).world[3].x, -7);
  EXPECT_EQ(xAt(sample, 0), 0);
  EXPECT_EQ(xAt(sample, 1.25), 2.5);
  EXPECT_EQ(xAt(sample, 2), 10);
  EXPECT_EQ(xAt(sample, 3), 20);
  EXPECT_EQ(xAt(sample, 100), 30);
  EXPECT_EQ(sample.load().animations.at(0).duration, 4);
}

TEST(GltfAnimation, StepHoldsTheKeyBefore) {
  Sample sample;
  sample.triangle();
  animate(sample, "translation", "STEP", {0, 1}, "VEC3", {1, 0, 0, 2, 0, 0});
  EXPECT_EQ(xAt(sample, 0.999), 1);
  EXPECT_EQ(xAt(sample, 1), 2);
}

TEST(GltfAnimation, CubicSplineIsHermiteWithTangentsPerSecond) {
  Sample sample;
  sample.triangle();
  // In-tangent, value, out-tangent. For x = t^3 over [1, 3]: values 1 and 27, slopes 3 and 27.
  animate(sample, "translation", "CUBICSPLINE", {1, 3}, "VEC3",
          {99, 0, 0, 1, 0, 0, 3, 0, 0, 27, 0, 0, 27, 0, 0, 99, 0, 0});
  for (const double t : {1.0, 1.5, 2.0, 2.9, 3.0}) EXPECT_NEAR(xAt(sample, t), t * t * t, 1e-13);
  EXPECT_EQ(xAt(sample, 0), 1);
  EXPECT_EQ(xAt(sample, 5), 27);
}

TEST(GltfAnimation, RotationsTurnAtConstantSpeedTheShortWay) {
  Sample sample;
  sample.triangle();
  const float h = std::sqrt(0.5f);
  // A quarter turn about +Z, given by the quaternion of the long way round.
  animate(sample, "rotation", "LINEAR", {0, 3}, "VEC4", {0, 0, 0, 1, 0, 0, -h, -h});
  for (const double t : {0.0, 1.0, 1.7, 3.0}) {
    const double angle = t / 3 * std::acos(-1) / 2;
    const glm::dmat4 world = at(sample, t).instances.at(0).world;
    EXPECT_NEAR(world[0].x, std::cos(angle), 1e-7);  // the keys are floats
    EXPECT_NEAR(world[0].y, std::sin(angle), 1e-7);
    EXPECT_NEAR(glm::length(world[1]), 1, 1e-15);
  }
}

TEST(GltfAnimation, WholeNumbersAreFractionsAndScaleStandsBesideRotation) {
  Sample sample;
  sample.triangle();
  sample.json["nodes"][0]["scale"] = {2, 2, 2};
  const int output = sample.accessor<std::int16_t>("VEC4", {0, 0, 0, 32767, 0, 0, 32767, 0});
  sample.json["accessors"][static_cast<std::size_t>(output)]["normalized"] = true;
  sample.add(
      "animations",
      {{"samplers", {{{"input", sample.accessor<float>("SCALAR", {0, 1})}, {"output", output}}}},
       {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "rotation"}}}}}}});
  const glm::dmat4 world = at(sample, 0.5).instances.at(0).world;
  EXPECT_NEAR(world[0].y, 2, 1e-15);  // a quarter turn, twice as large
  EXPECT_NEAR(world[0].x, 0, 1e-15);
}

TEST(GltfAnimation, SparseKeysAreRead) {
  Sample sample;
  sample.triangle();
  const int input = sample.accessor<float>("SCALAR", {0, 1});
  const int output = sample.add(
      "accessors",
      {{"componentType", 5126},
       {"type", "VEC3"},
       {"count", 2},
       {"sparse",
        {{"count", 1},
         {"indices", {{"bufferView", sample.view<std::uint8_t>({1})}, {"componentType", 5121}}},
         {"values", {{"bufferView", sample.view<float>({8, 0, 0})}}}}}});
  sample.add(
      "animations",
      {{"samplers", {{{"input", input}, {"output", output}}}},
       {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}});
  EXPECT_EQ(xAt(sample, 0.5), 4);
}

TEST(GltfAnimation, WeightsMoveManyMorphTargets) {
  Sample sample;
  Json& primitive = sample.triangle();
  primitive["targets"] = Json::array();
  std::vector<float> weights;
  for (int t = 0; t < 12; ++t) {
    std::vector<float> deltas(9, 0);
    deltas[0] = float(1 << t);
    primitive["targets"].push_back({{"POSITION", sample.accessor<float>("VEC3", deltas)}});
    weights.push_back(0);
  }
  weights.insert(weights.end(), 12, 1);
  animate(sample, "weights", "LINEAR", {0, 1}, "SCALAR", weights);
  sample.show({{"mesh", 0}});  // the same mesh at rest next to it
  const glint::Scene scene = at(sample, 0.5);
  ASSERT_EQ(scene.instances.size(), 2u);
  const auto x = [&](std::size_t i) {
    const glint::Mesh& mesh = scene.meshes[std::size_t(scene.instances[i].mesh)];
    return mesh.origin.x + double(mesh.positions[0].x);
  };
  EXPECT_EQ(x(0), 4095 * 0.5);
  EXPECT_EQ(x(1), 0);
}

TEST(GltfAnimation, ASkinFollowsItsJoints) {
  Sample sample;
  Json& primitive = sample.triangle();
  primitive["attributes"]["JOINTS_0"] =
      sample.accessor<std::uint16_t>("VEC4", {300, 0, 0, 0, 300, 0, 0, 0, 0, 0, 0, 0});
  primitive["attributes"]["WEIGHTS_0"] =
      sample.accessor<float>("VEC4", {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
  Json joints = Json::array();
  for (int i = 0; i <= 300; ++i) joints.push_back(sample.add("nodes", {{"name", "joint"}}));
  sample.json["skins"] = {{{"joints", joints}}};
  sample.json["nodes"][0]["skin"] = 0;
  animate(sample, "translation", "", {0, 1}, "VEC3", {0, 0, 0, 0, 0, 6});
  sample.json["animations"][0]["channels"][0]["target"]["node"] = joints[300];
  const glint::Scene scene = at(sample, 0.5);
  EXPECT_EQ(scene.meshes.at(0).positions.at(0).z, 3);
  EXPECT_EQ(scene.meshes.at(0).positions.at(2).z, 0);
  EXPECT_EQ(sample.load().meshes.at(0).positions.at(0).z, 0);
}

TEST(GltfAnimation, IsChosenByNameOrNumber) {
  Sample sample;
  sample.triangle();
  for (const float x : {1.0f, 2.0f, 3.0f})
    animate(sample, "translation", "", {0}, "VEC3", {x, 0, 0});
  sample.json["animations"][1]["name"] = "walk";
  sample.json["animations"][2]["name"] = "0";
  const auto x = [&](const char* name) { return at(sample, 0, name).instances[0].world[3].x; };
  EXPECT_EQ(x(""), 1);
  EXPECT_EQ(x("walk"), 2);
  EXPECT_EQ(x("1"), 2);
  EXPECT_EQ(x("0"), 3);  // a name takes precedence over a number
  for (const char* bad : {"run", "3", "-1", "1.0", "99999999999999999999"}) {
    EXPECT_THAT(glint::test::messageOf([&] { x(bad); }),
                testing::AllOf(HasSubstr("--animation: sample has no animation '"),
                               HasSubstr("use 0, 1 'walk', 2 '0'")));
  }
}

TEST(GltfAnimation, AModelWithoutOneIsShownAtRestWithAWarning) {
  Sample sample;
  sample.triangle();
  EXPECT_THAT(at(sample, 1).warnings, ElementsAre(HasSubstr("has no animation")));
  EXPECT_THROW(at(sample, 1, "walk"), glint::InputError);
}

TEST(GltfAnimation, PosesAgainAndAgainWithoutReadingAgain) {
  Sample sample;
  sample.triangle();
  sample.show({{"mesh", 0}, {"name", "still"}});
  animate(sample, "translation", "", {0, 1}, "VEC3", {0, 0, 0, 10, 0, 0});
  glint::SceneFile file(sample.writeGltf());
  glint::Scene scene = file.take({0.5, {}});
  EXPECT_EQ(scene.instances.at(0).world[3].x, 5);
  std::filesystem::remove(sample.folder() / "sample.bin");
  EXPECT_THAT(file.pose(scene, {1.0, {}}), IsEmpty());  // rigid: no vertex changes
  EXPECT_EQ(scene.instances.at(0).world[3].x, 10);
  EXPECT_EQ(scene.instances.at(1).world[3].x, 0);
  EXPECT_EQ(scene.meshes.size(), 1u);
  EXPECT_THAT(file.pose(scene, {}), IsEmpty());
  EXPECT_EQ(scene.instances.at(0).world[3].x, 0);
}

TEST(GltfAnimation, PosingTellsWhichMeshesAreNew) {
  Sample sample;
  sample.primitive({{"attributes",
                     {{"POSITION", sample.accessor<float>("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0})}}}});
  Json& primitive = sample.triangle();
  primitive["targets"] = {
      {{"POSITION", sample.accessor<float>("VEC3", {1, 0, 0, 1, 0, 0, 1, 0, 0})}}};
  animate(sample, "weights", "", {0, 1}, "SCALAR", {0, 1});
  sample.json["animations"][0]["channels"][0]["target"]["node"] = 1;
  glint::SceneFile file(sample.writeGltf());
  glint::Scene scene = file.take({0.0, {}});
  ASSERT_EQ(scene.meshes.size(), 2u);
  EXPECT_THAT(file.pose(scene, {0.5, {}}), ElementsAre(1));
  EXPECT_EQ(scene.meshes[1].positions[0].x, 0.5f);
  EXPECT_EQ(scene.meshes.size(), 2u);
}

TEST(GltfAnimation, ChannelsThatCannotBePlayedAreLeftOut) {
  struct Case {
    const char* what;
    void (*breakIt)(Json& animation, Json& document);
    const char* warning;
  };
  const Case cases[] = {
      {"path", [](Json& a, Json&) { a["channels"][0]["target"]["path"] = "colour"; }, "colour"},
      {"matrix",
       [](Json&, Json& d) {
         d["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
       },
       "has a matrix"},
      {"weights of nothing", [](Json& a, Json&) { a["channels"][0]["target"]["path"] = "weights"; },
       "a node that has none"},
      {"too few values",
       [](Json& a, Json& d) { d["accessors"][a["samplers"][0]["output"].get<int>()]["count"] = 1; },
       "3 numbers for 2 keys of 3"},
      {"times of the wrong type",
       [](Json& a, Json& d) {
         d["accessors"][a["samplers"][0]["input"].get<int>()]["componentType"] = 5125;
       },
       "has no keys"},
      {"no keys",
       [](Json& a, Json& d) { d["accessors"][a["samplers"][0]["input"].get<int>()]["count"] = 0; },
       "has no keys"},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.what);
    Sample sample;
    sample.triangle();
    animate(sample, "translation", "", {0, 1}, "VEC3", {5, 0, 0, 5, 0, 0});
    c.breakIt(sample.json["animations"][0], sample.json);
    const glint::Scene scene = at(sample, 1);
    EXPECT_EQ(scene.instances.at(0).world[3].x, 0);
    ASSERT_FALSE(scene.warnings.empty());
    EXPECT_THAT(scene.warnings.back(), HasSubstr(c.warning));
    EXPECT_THAT(sample.load().warnings, IsEmpty());  // not read in the rest pose
  }
}

TEST(GltfAnimation, KeysThatDoNotAscendOrAreNotFiniteAreLeftOut) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  constexpr float inf = std::numeric_limits<float>::infinity();
  for (const std::vector<float>& times : {std::vector<float>{1, 0}, {0, nan}, {nan, 0}, {0, inf}}) {
    Sample sample;
    sample.triangle();
    animate(sample, "translation", "", times, "VEC3", {5, 0, 0, 5, 0, 0});
    const glint::Scene scene = at(sample, 0.5);
    EXPECT_EQ(scene.instances.at(0).world[3].x, 0);
    EXPECT_THAT(scene.warnings,
                testing::Contains(HasSubstr("times that decrease or are not finite")));
  }
  Sample sample;
  sample.triangle();
  animate(sample, "translation", "", {0, 1}, "VEC3", {5, 0, 0, nan, 0, 0});
  EXPECT_THAT(at(sample, 1).warnings, testing::Contains(HasSubstr("not finite")));
}

TEST(GltfAnimation, IndicesThatPointToNothingAreRefusedWhenPlayed) {
  struct Case {
    void (*breakIt)(Json& animation);
    const char* message;
  };
  const Case cases[] = {
      {[](Json& a) { a["channels"][0]["sampler"] = 1; }, "animations[0].channels[0].sampler"},
      {[](Json& a) { a["channels"][0]["target"]["node"] = 9; }, "target.node"},
      {[](Json& a) { a["samplers"][0]["input"] = 99; }, "samplers[0].input"},
      {[](Json& a) { a["samplers"][0]["output"] = -1; }, "samplers[0].output"},
      {[](Json& a) { a["samplers"] = 5; }, "samplers"},
      {[](Json& a) { a["channels"] = Json::object(); }, "channels"},
      {[](Json& a) { a = 3; }, "animations[0]"},
  };
  for (const Case& c : cases) {
    Sample sample;
    sample.triangle();
    animate(sample, "translation", "", {0, 1}, "VEC3", {5, 0, 0, 5, 0, 0});
    c.breakIt(sample.json["animations"][0]);
    EXPECT_EQ(sample.error(), "");
    EXPECT_THAT(glint::test::messageOf([&] { at(sample, 1); }), HasSubstr(c.message));
  }
}

TEST(GltfNodes, HiddenNodesHideWhatIsBelowThem) {
  Sample sample;
  sample.triangle();
  sample.json["nodes"][0]["children"] = {1};
  sample.add("nodes", {{"mesh", 0}, {"translation", {5, 0, 0}}});
  sample.show({{"mesh", 0}});
  EXPECT_EQ(sample.load().instances.size(), 3u);
  sample.json["nodes"][0]["extensions"] = {{"KHR_node_visibility", {{"visible", false}}}};
  sample.json["extensionsUsed"] = {"KHR_node_visibility"};
  const glint::Scene scene = sample.load();
  EXPECT_EQ(scene.instances.size(), 1u);
  EXPECT_THAT(scene.warnings, IsEmpty());
  sample.json["nodes"][0]["extensions"] = {{"KHR_node_visibility", {{"visible", 3}}}};
  EXPECT_THAT(sample.error(), HasSubstr("visible"));
}

}  // namespace gltf_animation_test
