// Nodes, instances, skins, morph targets and cameras.
#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "glint/scene/camera.h"
#include "gltf_sample.h"

namespace gltf_pose_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using Json = Sample::Json;

glm::dvec3 apply(const glm::dmat4& matrix, const glm::dvec3& point) {
  return glm::dvec3(matrix * glm::dvec4(point, 1));
}

void expectNear(const glm::dvec3& a, const glm::dvec3& b, double tolerance) {
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(a[k], b[k], tolerance) << a.x << " " << a.y << " " << a.z;
  }
}

TEST(GltfNodes, MatrixAndTrsAgreeThroughAHierarchy) {
  Sample sample;
  sample.triangle();
  const double half = std::sqrt(0.5);
  // A quarter turn about +Z, scaled by two along x, translated; as components and as a matrix.
  sample.json["nodes"] = {
      {{"translation", {10, 0, 0}},
       {"rotation", {0, 0, half, half}},
       {"scale", {2, 1, 1}},
       {"children", {1}}},
      {{"mesh", 0}, {"translation", {1, 0, 0}}},
      {{"matrix", {0, 2, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 10, 0, 0, 1}}, {"children", {3}}},
      {{"mesh", 0}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 1}}}};
  sample.json["scenes"][0]["nodes"] = {0, 2};
  const glint::Scene scene = sample.load();
  ASSERT_EQ(scene.instances.size(), 2u);
  EXPECT_EQ(scene.meshes.size(), 1u);
  for (const auto& instance : scene.instances) {
    // (1, 1, 0) is moved to (2, 1, 0), scaled to (4, 1, 0), rotated to (-1, 4, 0), translated.
    // The square root of a half is off by 2^-54, its square by less than 2^-52.
    expectNear(apply(instance.world, {1, 1, 0}), {9, 4, 0}, 4e-15);
  }
}

TEST(GltfNodes, QuaternionsAreNormalised) {
  Sample sample;
  sample.triangle();
  sample.json["nodes"][0]["rotation"] = {0, 0, 3, 3};
  expectNear(apply(sample.load().instances.at(0).world, {1, 0, 0}), {0, 1, 0}, 4e-16);
  sample.json["nodes"][0]["rotation"] = {1e-300, 0, 0, 1e-300};
  expectNear(apply(sample.load().instances.at(0).world, {0, 1, 0}), {0, 0, 1}, 4e-16);
  sample.json["nodes"][0]["rotation"] = {0, 0, 0, 0};
  const glint::Scene scene = sample.load();
  EXPECT_EQ(scene.instances.at(0).world, glm::dmat4(1));
  EXPECT_THAT(scene.warnings, ElementsAre(HasSubstr("nodes[0]: its rotation is 0")));
}

TEST(GltfNodes, TransformsThatNoPictureHoldsAreRefused) {
  Sample sample;
  sample.triangle();
  sample.json["nodes"] = {{{"scale", {1e200, 1, 1}}, {"children", {1}}, {"name", "big"}},
                          {{"scale", {1e200, 1, 1}}, {"mesh", 0}}};
  EXPECT_THAT(sample.error(), HasSubstr("nodes[0] \"big\" has a transform that is not finite"));
  sample.json["nodes"] = {{{"scale", {1e20, 1, 1}}, {"mesh", 0}}};
  EXPECT_EQ(sample.error(), "");
}

TEST(GltfNodes, LastRowOfAMatrixIsIgnored) {
  Sample sample;
  sample.triangle();
  sample.json["nodes"][0]["matrix"] = {1, 0, 0, 5, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 2};
  const glint::Scene scene = sample.load();
  EXPECT_EQ(scene.instances.at(0).world, glm::dmat4(1));
  EXPECT_THAT(scene.warnings, ElementsAre(HasSubstr("the last row of its matrix")));
}

TEST(GltfNodes, TheSceneShown) {
  Sample sample;
  sample.triangle();
  sample.json["nodes"] = {{{"mesh", 0}},
                          {{"mesh", 0}, {"translation", {1, 0, 0}}, {"children", {2}}},
                          {{"mesh", 0}, {"translation", {1, 0, 0}}}};
  const auto places = [&] {
    std::vector<double> x;
    for (const auto& instance : sample.load().instances) x.push_back(instance.world[3].x);
    return x;
  };
  sample.json["scenes"] = {{{"nodes", {0}}}, {{"nodes", {1}}}, {{"nodes", {2, 1, 1}}}};
  EXPECT_THAT(places(), ElementsAre(0));
  sample.json["scene"] = 1;
  EXPECT_THAT(places(), ElementsAre(1, 2));
  sample.json["scene"] = 2;  // not roots, and one twice: each is drawn once, in its own place
  EXPECT_THAT(places(), ElementsAre(2, 1));
  sample.json.erase("scene");
  sample.json.erase("scenes");
  EXPECT_THAT(places(), ElementsAre(0, 1, 2));
}

TEST(GltfMorph, WeightsOfTheNodeBeatThoseOfTheMesh) {
  Sample sample;
  Json& primitive = sample.triangle();
  primitive["attributes"]["NORMAL"] = sample.accessor<float>("VEC3", {0, 0, 1, 0, 0, 1, 0, 0, 1});
  primitive["targets"] = {
      {{"POSITION", sample.accessor<float>("VEC3", {0, 0, 0, 2, 0, 0, 0, 0, 0})}},
      {{"POSITION", sample.accessor<float>("VEC3", {0, 0, 8, 0, 0, 8, 0, 0, 8})},
       {"NORMAL", sample.accessor<float>("VEC3", {2, 0, 0, 2, 0, 0, 2, 0, 0})}}};
  sample.json["meshes"][0]["weights"] = {0.5, 0};
  sample.show({{"mesh", 0}, {"weights", {0, 0.5}}});
  sample.show({{"mesh", 0}, {"weights", {0, 0}}});
  sample.show({{"mesh", 0}});
  const glint::Scene scene = sample.load();
  ASSERT_EQ(scene.instances.size(), 4u);
  ASSERT_EQ(scene.meshes.size(), 3u);  // the first and the last have the same pose
  EXPECT_EQ(scene.meshes[0].positions.at(1), glm::vec3(2, 0, 0));
  EXPECT_EQ(scene.meshes[0].normals.at(1), glm::vec3(0, 0, 1));
  const glint::Mesh& raised = scene.meshes[1];
  EXPECT_EQ(raised.origin + glm::dvec3(raised.positions.at(1)), glm::dvec3(1, 0, 4));
  expectNear(raised.normals.at(1), glm::dvec3(std::sqrt(0.5), 0, std::sqrt(0.5)), 3e-8);
  EXPECT_EQ(scene.meshes[2].positions.at(1), glm::vec3(1, 0, 0));
  EXPECT_EQ(scene.instances[3].mesh, 0);
}

/// The triangle, with its first vertex bound to joint 0 and the second to both, under a node that
/// is moved far away.
struct SkinSample : Sample {
  SkinSample() {
    Json& attributes = triangle()["attributes"];
    attributes["NORMAL"] = accessor<float>("VEC3", {0, 0, 1, 0, 0, 1, 0, 0, 1});
    bind({1, 0, 0, 0, 2, 2, 0, 0, 0, 1, 0, 0});
    const std::vector<float> inverse = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0,  0, 0, 1,
                                        1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -7, 0, 0, 1};
    json["nodes"][0]["skin"] = 0;
    json["nodes"][0]["translation"] = {100, 100, 100};
    show({{"translation", {0, 0, 5}}});
    show({{"translation", {7, 4, 0}}});
    json["skins"] = {{{"joints", {1, 2}}, {"inverseBindMatrices", accessor("MAT4", inverse)}}};
  }
  void bind(const std::vector<float>& weights) {
    Json& attributes = json["meshes"][0]["primitives"][0]["attributes"];
    attributes["JOINTS_0"] = accessor<std::uint8_t>("VEC4", {0, 1, 9, 9, 0, 1, 0, 0, 0, 1, 0, 0});
    attributes["WEIGHTS_0"] = accessor("VEC4", weights);
  }
};

TEST(GltfSkin, VerticesFollowTheirJoints) {
  SkinSample sample;
  const glint::Scene scene = sample.load();
  EXPECT_THAT(scene.warnings, IsEmpty());
  EXPECT_EQ(scene.instances.at(0).world, glm::dmat4(1));
  const auto& mesh = scene.meshes.at(0);
  EXPECT_EQ(mesh.positions.at(0), glm::vec3(0, 0, 5));
  EXPECT_EQ(mesh.positions.at(1), glm::vec3(1, 2, 2.5f));  // weights 2 and 2 are a half each
  EXPECT_EQ(mesh.positions.at(2), glm::vec3(0, 5, 0));
}

TEST(GltfSkin, NormalsFollowTheCofactors) {
  SkinSample sample;
  sample.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] =
      sample.accessor<float>("VEC3", {0, 1, 1, 0, 1, 1, 0, 1, 1});
  sample.json["nodes"][1]["scale"] = {1, 1, 10};
  const glint::Mesh mesh = sample.load().meshes.at(0);
  expectNear(mesh.normals.at(0), glm::dvec3(0, 10, 1) / std::sqrt(101.0), 3e-8);
  // A mirrored skeleton: faces and normals stay on the same side.
  for (const int node : {1, 2}) {
    sample.json["nodes"][static_cast<std::size_t>(node)]["scale"] = {1, 1, -1};
  }
  sample.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] =
      sample.accessor<float>("VEC3", {0, 0, 1, 0, 0, 1, 0, 0, 1});
  const glint::Mesh mirrored = sample.load().meshes.at(0);
  EXPECT_EQ(mirrored.normals.at(0), glm::vec3(0, 0, -1));
  EXPECT_THAT(mirrored.indices, ElementsAre(0, 2, 1));
}

TEST(GltfSkin, BadWeightsAreMended) {
  SkinSample sample;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  sample.bind({0, 0, 0, 0, nan, 1, 0, 0, -1, 1, 0, 0});
  const glint::Scene scene = sample.load();
  EXPECT_THAT(scene.warnings, ElementsAre(HasSubstr("3 vertices have joint weights")));
  const auto& mesh = scene.meshes.at(0);
  EXPECT_EQ(mesh.positions.at(0), glm::vec3(0, 0, 5));
  EXPECT_EQ(mesh.positions.at(1), glm::vec3(1, 4, 0));
}

TEST(GltfSkin, JointsOutOfRangeAreRefused) {
  SkinSample sample;
  sample.bind({1, 0, 1, 0, 1, 0, 0, 0, 1, 0, 0, 0});
  EXPECT_THAT(sample.error(), HasSubstr("a vertex is bound to a joint beyond the 2 of its skin"));
  SkinSample other;
  other.json["skins"][0]["joints"] = {1, 2, 1};
  EXPECT_THAT(other.error(), HasSubstr("must refer to an accessor with a MAT4 of floats"));
}

TEST(GltfSkin, MeshWithoutBindingsStandsAtItsNode) {
  SkinSample sample;
  sample.json["meshes"][0]["primitives"][0]["attributes"].erase("JOINTS_0");
  EXPECT_EQ(sample.load().instances.at(0).world[3].x, 100);
}

TEST(GltfCamera, PerspectiveAndOrthographic) {
  Sample sample;
  sample.triangle();
  sample.json["cameras"] = {
      {{"type", "orthographic"},
       {"name", "plan"},
       {"orthographic", {{"xmag", 2}, {"ymag", 3}, {"znear", 0}, {"zfar", 10}}}},
      {{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.1}}}}};
  const double half = std::sqrt(0.5);
  sample.show({{"camera", 1}, {"translation", {1, 2, 3}}, {"name", "eye"}});
  sample.show({{"camera", 0}, {"rotation", {0, half, 0, half}}, {"scale", {-3, 2, 5}}});
  const auto cameras = sample.load().cameras;
  ASSERT_EQ(cameras.size(), 2u);
  EXPECT_EQ(cameras[1].name, "eye");
  EXPECT_FALSE(cameras[1].orthographic);
  EXPECT_EQ(cameras[1].viewAngle, 0.5);
  EXPECT_EQ(cameras[1].near, 0.1);
  EXPECT_EQ(cameras[1].far, 0);
  EXPECT_EQ(glm::dvec3(cameras[1].world[3]), glm::dvec3(1, 2, 3));
  EXPECT_EQ(cameras[0].name, "plan");
  EXPECT_TRUE(cameras[0].orthographic);
  EXPECT_EQ(cameras[0].halfHeight, 3);
  EXPECT_EQ(cameras[0].far, 10);
  // A quarter turn about +Y; scale, including mirroring, is ignored.
  expectNear(glm::dvec3(cameras[0].world[2]), {1, 0, 0}, 4e-16);
  expectNear(glm::dvec3(cameras[0].world[0]), {0, 0, -1}, 4e-16);
}

// The number of a camera is its index in the file, whatever nodes there are. The first node of the
// scene that uses it places it; the further ones follow after the last camera.
TEST(GltfCamera, CamerasKeepTheirNumbersOfTheFile) {
  Sample sample;
  sample.triangle();
  for (const double yfov : {0.5, 0.6, 0.7, 4.0, 0.9})
    sample.add("cameras", {{"type", "perspective"},
                           {"name", "c" + std::to_string(sample.json["cameras"].size())},
                           {"perspective", {{"yfov", yfov}, {"znear", 0.1}}}});
  sample.add("nodes", {{"camera", 2}});  // of no scene
  for (const int camera : {4, 3, 1, 0, 4, 1})
    sample.show({{"camera", camera}, {"translation", {sample.json["nodes"].size(), 0, 0}}});
  sample.json["nodes"].back()["name"] = "again";
  sample.show({{"camera", 0}, {"scale", {0, 0, 0}}});
  const glint::Scene scene = sample.load();
  const auto& cameras = scene.cameras;
  ASSERT_EQ(cameras.size(), 8u);
  const double unusable = 0;
  const struct {
    const char* name;
    double viewAngle, x;
  } expected[] = {{"c0", 0.5, 5}, {"c1", 0.6, 4},      {"c2", unusable, 0}, {"c3", unusable, 0},
                  {"c4", 0.9, 2}, {"c0", unusable, 0}, {"again", 0.6, 7},   {"c4", 0.9, 6}};
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    SCOPED_TRACE(i);
    EXPECT_EQ(cameras[i].name, expected[i].name);
    EXPECT_EQ(cameras[i].unusable.empty(), expected[i].viewAngle != unusable);
    if (!cameras[i].unusable.empty()) continue;
    EXPECT_EQ(cameras[i].viewAngle, expected[i].viewAngle);
    EXPECT_EQ(cameras[i].world[3].x, expected[i].x);
  }
  EXPECT_THAT(glint::usableCameras(scene), testing::ElementsAre(0, 1, 4, 6, 7));
  EXPECT_EQ(scene.warnings.size(), 2u);
  const auto refusal = [&](int index) {
    glint::Look look;
    look.cameraIndex = index;
    try {
      glint::cameraFor(scene, glint::boundsOf(scene), look);
    } catch (const glint::InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::string advice = ": give 0, 1, 4, 6 or 7";
  EXPECT_EQ(refusal(2),
            "--camera-index 2: sample: cameras[2] \"c2\" is used by no node of the scene" + advice);
  EXPECT_EQ(refusal(3),
            "--camera-index 3: sample: cameras[3] \"c3\" has a yfov outside 0 to pi" + advice);
  EXPECT_EQ(refusal(5),
            "--camera-index 5: sample: cameras[5] \"c0\" is at a node of scale 0" + advice);
  EXPECT_EQ(refusal(8), "--camera-index 8: sample has 8 cameras" + advice);
  EXPECT_EQ(refusal(7), "");
}

TEST(GltfCamera, UnusableCamerasAreLeftOut) {
  Sample sample;
  sample.triangle();
  sample.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 4}}}},
                            {{"type", "panorama"}},
                            {{"type", "orthographic"}, {"orthographic", {{"ymag", 0}}}}};
  for (int i = 0; i < 3; ++i) sample.show({{"camera", i}});
  const glint::Scene scene = sample.load();
  EXPECT_EQ(scene.cameras.size(), 3u);
  EXPECT_THAT(glint::usableCameras(scene), IsEmpty());
  EXPECT_EQ(scene.warnings.size(), 3u);
  sample.json["cameras"][0]["perspective"] = 5;
  EXPECT_THAT(sample.error(), HasSubstr("cameras[0].perspective must be an object"));
}

}  // namespace gltf_pose_test
