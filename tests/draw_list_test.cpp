// What is drawn, in which order, with which matrices and lights; decided without GL.

#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "glint/image/error.h"
#include "glint/options/parameters.h"
#include "glint/render/draw_list.h"
#include "scenes.h"

namespace glint::test::draw_list_test {

constexpr double half = 1.0 / (1 << 24);  // relative rounding error of float: half an ulp

using Real = long double;
using Vector = std::array<Real, 3>;
using Matrix = std::array<Vector, 3>;  // [row][column]

DrawList listOf(const Scene& scene, const Look& look) {
  return glint::makeDrawList(scene, glint::boundsOf(scene), look);
}

Matrix product(const Matrix& a, const Matrix& b) {
  Matrix c{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k) c[i][j] += a[i][k] * b[k][j];
  return c;
}

Matrix fromGlm(const glm::dmat3& m) {
  Matrix r;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) r[std::size_t(i)][std::size_t(j)] = m[j][i];
  return r;
}

// The adjugate's columns divided by the determinant, transposed; in long double for its range.
Matrix inverseTranspose(const Matrix& m) {
  Matrix c;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      const std::size_t i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      c[i][j] = m[i1][j1] * m[i2][j2] - m[i1][j2] * m[i2][j1];
    }
  const Real det = m[0][0] * c[0][0] + m[0][1] * c[0][1] + m[0][2] * c[0][2];
  for (Vector& row : c)
    for (Real& x : row) x /= det;
  return c;
}

const glm::dvec3 normals[] = {{0, 0, 1},  {1, 0, 0},        {0, 1, 1},
                              {1, 2, -3}, {-0.3, 0.1, 0.2}, {1, 1, 1}};

// Compares the direction of the normal matrix times n with that of the inverse transpose.
void expectNormalMatrix(const glm::dmat4& world) {
  const Look look = glint::test::parallelLook({1, 2, 3});
  const Scene scene = glint::test::sceneOf(glint::test::quad(), {}, world);
  const DrawList list = listOf(scene, look);
  ASSERT_EQ(list.items.size(), 1u);
  const glm::mat3x4& matrix = list.items[0].draw.normalMatrix;
  const Matrix exact = inverseTranspose(
      product(fromGlm(glm::transpose(list.camera.axes)), fromGlm(glm::dmat3(world))));
  for (const glm::dvec3& n : normals) {
    Vector expected{}, actual{}, size{};
    Real expectedLength = 0, actualLength = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        expected[i] += exact[i][j] * n[int(j)];
        actual[i] += Real(matrix[int(j)][int(i)]) * n[int(j)];
        size[i] += std::abs(Real(matrix[int(j)][int(i)]) * n[int(j)]);
      }
      expectedLength += expected[i] * expected[i];
      actualLength += actual[i] * actual[i];
    }
    expectedLength = std::sqrt(expectedLength);
    actualLength = std::sqrt(actualLength);
    ASSERT_GT(actualLength, 0);
    for (std::size_t i = 0; i < 3; ++i) {
      // Each entry is rounded once to float; the rest is in double (about ten operations of 2^-53).
      const Real tolerance = (size[0] + size[1] + size[2]) * (half + 1e-14) / actualLength;
      EXPECT_NEAR(double(actual[i] / actualLength), double(expected[i] / expectedLength),
                  double(tolerance))
          << "n = " << n.x << "," << n.y << "," << n.z;
    }
  }
}

glint::Material blended(const char* name) {
  glint::Material m;
  m.name = name;
  m.alphaMode = glint::AlphaMode::blend;
  m.alpha = 0.5;
  return m;
}

TEST(NormalMatrix, IsTheInverseTransposeUnderEveryTransform) {
  using glint::test::rotation, glint::test::scaling, glint::test::translation;
  glm::dmat4 shear(1);
  shear[1][0] = 0.7;
  shear[2][1] = -2;
  for (const double scale : {1.0, 1e-20, 1e20, 1e-3}) {
    SCOPED_TRACE(scale);
    expectNormalMatrix(scaling(glm::dvec3(scale)));  // B4, B5
    expectNormalMatrix(rotation(1.1) * scaling(glm::dvec3(scale)));
    expectNormalMatrix(rotation(1.1) * scaling(scale * glm::dvec3(1, 1, 10)));  // B1
    expectNormalMatrix(scaling(scale * glm::dvec3(-1, 1, 1)));                  // B2
    expectNormalMatrix(scaling(scale * glm::dvec3(-1, -1, -1)));                // B3
    expectNormalMatrix(rotation(0.4) * scaling(scale * glm::dvec3(-0.1, 1, 2)));
    expectNormalMatrix(rotation(2) * shear * scaling(glm::dvec3(scale)));  // B7
    expectNormalMatrix(translation({1e6, 0, 0}) * shear * scaling(scale * glm::dvec3(1, -1, 2)));
  }
}

TEST(NormalMatrix, OfSingularTransformsIsFinite) {
  for (const glm::dvec3 scale : {glm::dvec3(1, 1, 0), glm::dvec3(1, 0, 0), glm::dvec3(0, 0, 0),
                                 glm::dvec3(1e-300, 1e-300, 0)}) {
    const DrawList list =
        listOf(glint::test::sceneOf(glint::test::quad(), {}, glint::test::scaling(scale)),
               glint::test::parallelLook());
    for (const DrawItem& item : list.items)
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) EXPECT_TRUE(std::isfinite(item.draw.normalMatrix[i][j]));
  }
  // B6: geometry flattened onto the plane z = 0 has that plane's normal.
  const DrawList list =
      listOf(glint::test::sceneOf(glint::test::quad(), {}, glint::test::scaling({1, 1, 0})),
             glint::test::parallelLook());
  const glm::mat3x4& m = list.items.at(0).draw.normalMatrix;
  EXPECT_EQ(glm::vec3(m[2]), glm::vec3(0, 0, 1));
  EXPECT_EQ(glm::vec3(m[0]), glm::vec3(0));
}

// With a uniform scale the matrix is a rotation: normals keep unit length without a division.
TEST(NormalMatrix, KeepsUnitLengthUnderOneScale) {
  for (double scale : {1e-20, 0.3, 1.0, 1e20}) {
    const DrawList list = listOf(
        glint::test::sceneOf(glint::test::quad(), {},
                             glint::test::rotation(1) * glint::test::scaling(glm::dvec3(scale))),
        glint::test::parallelLook({3, 1, 2}));
    EXPECT_FALSE(list.items.at(0).variant.unevenScale);
    for (int i = 0; i < 3; ++i) {
      const glm::dvec3 column(glm::vec3(list.items[0].draw.normalMatrix[i]));
      EXPECT_NEAR(glm::length(column), 1, 2 * half);
    }
  }
}

TEST(DrawList, PlacesInDoubleUpToTheEye) {
  // At 1e7 floats are 1 apart: only differences formed in double place a vertex to 1e-7.
  const glm::dvec3 far(1e7 + 0.123456789, -1e7, 3e6);
  Look look = glint::test::parallelLook();
  look.cameraPosition = far + glm::dvec3(0, 0, 4);
  look.cameraFocalPoint = far;
  Scene scene = glint::test::sceneOf(glint::test::quad(), {}, glint::test::translation(far));
  const auto eye = [&] {
    const DrawList list = listOf(scene, look);
    return glm::dvec3(list.items.at(0).draw.eyeFromModel[3]) * list.camera.unit;
  };
  // 1e7 has an ulp of 1.9e-9 in double, to which the sum eye = far + 4 is rounded.
  EXPECT_NEAR(eye().x, 0, 2e-9);
  EXPECT_NEAR(eye().z, -4, 4 * half + 2e-9);
  // The same with the distance in the mesh's origin.
  scene.instances[0].world = glm::dmat4(1);
  scene.meshes[0].origin = far;
  EXPECT_NEAR(eye().x, 0, 2e-9);
  EXPECT_NEAR(eye().z, -4, 4 * half + 2e-9);
}

TEST(DrawList, PowersOfTwoGiveTheSameFloats) {
  const Scene base = glint::test::sceneOf(glint::test::sphere(12, 6), {},
                                          glint::test::translation({0.2, 0.1, -0.4}));
  const DrawList list = listOf(base, {});
  for (int k : {-60, -1, 5, 60}) {
    Scene scene = base;
    scene.instances[0].world =
        glint::test::scaling(glm::dvec3(std::exp2(k))) * base.instances[0].world;
    const DrawList scaled = listOf(scene, {});
    EXPECT_EQ(scaled.items.at(0).draw.eyeFromModel, list.items.at(0).draw.eyeFromModel);
    EXPECT_EQ(scaled.items[0].draw.normalMatrix, list.items[0].draw.normalMatrix);
  }
}

TEST(DrawList, LeavesOutWhatFloatCannotPlace) {
  Scene scene = glint::test::sceneOf(glint::test::quad());
  scene.instances.push_back({0, glint::test::translation({1e300, 0, 0})});
  const DrawList list = glint::makeDrawList(scene, {{0, 0, 0}, 1}, {});
  EXPECT_EQ(list.items.size(), 1u);
}

TEST(DrawList, MirroredTransformsAreMarked) {
  const auto mirrored = [](const glm::dmat4& world) {
    return listOf(glint::test::sceneOf(glint::test::quad(), {}, world), {}).items.at(0).mirrored;
  };
  using glint::test::rotation, glint::test::scaling;
  EXPECT_FALSE(mirrored(glm::dmat4(1)));
  EXPECT_TRUE(mirrored(scaling({-1, 1, 1})));
  EXPECT_TRUE(mirrored(rotation(1) * scaling({-1, -1, -1})));
  EXPECT_FALSE(mirrored(scaling({-1, -1, 1})));
  EXPECT_FALSE(mirrored(scaling(glm::dvec3(1e-20))));
  EXPECT_TRUE(mirrored(scaling({1e-20, -1e-20, 1e-20})));
  EXPECT_TRUE(mirrored(scaling({1e20, 1e20, -1e20})));
  EXPECT_TRUE(mirrored(scaling({1e-120, 1e-120, -1e-120})));  // the product underflows
}

TEST(DrawList, FacesOfBothSidesForTheirReasons) {
  const auto faces = [](glint::Topology topology, bool material, bool look) {
    Scene scene = glint::test::sceneOf(glint::test::quad());
    scene.meshes[0].topology = topology;
    scene.materials[0].doubleSided = material;
    Look l;
    l.twoSided = look;
    return listOf(scene, l).items.at(0).faces;
  };
  EXPECT_EQ(faces(glint::Topology::triangles, false, false), FaceSide::front);
  EXPECT_EQ(faces(glint::Topology::triangles, true, false), FaceSide::both);
  EXPECT_EQ(faces(glint::Topology::triangles, false, true), FaceSide::both);
  EXPECT_EQ(faces(glint::Topology::lines, false, false), FaceSide::both);
}

TEST(DrawList, BlendedThingsComeLastFromBackToFrontStably) {
  Scene scene = glint::test::sceneOf(glint::test::quad({0, 0, 1}, 0.1f), blended("b"));
  scene.materials.push_back(glint::test::materialOf(1, 1, 0, 1));
  glint::Mesh opaque = glint::test::quad({0, 0, 1}, 0.1f);
  opaque.material = 1;
  scene.meshes.push_back(opaque);
  scene.instances.clear();
  const double depths[] = {0.3, -1, 0.3, 2, -1, 0};  // along +Z, towards the viewer
  for (double z : depths) scene.instances.push_back({0, glint::test::translation({0, 0, z})});
  scene.instances.push_back({1, glint::test::translation({0, 0, 3})});
  scene.instances.push_back({1, glint::test::translation({0, 0, -3})});
  const DrawList list = listOf(scene, glint::test::parallelLook());
  std::vector<int> order;
  for (const DrawItem& item : list.items) order.push_back(item.instance);
  EXPECT_THAT(order, testing::ElementsAre(6, 7, 1, 4, 5, 0, 2, 3));
  EXPECT_TRUE(list.items.back().blended);
  EXPECT_FALSE(list.items.front().blended);
}

TEST(DrawList, BlendedDepthIsThatOfTheBoxsCentre) {
  Scene scene = glint::test::sceneOf(glint::test::quad(), blended("b"));
  scene.meshes[0].positions.emplace_back(0, 0, 50);  // unused by any triangle
  Look look = glint::test::parallelLook();
  const DrawList list = glint::makeDrawList(scene, {{0, 0, 0}, 3}, look);
  EXPECT_NEAR(list.items.at(0).depth * list.camera.unit, 4, 1e-6);
}

TEST(DrawList, BothSidesOfBlendedThingsAreDrawnAtOnce) {
  Scene scene = glint::test::sceneOf(glint::test::quad(), blended("b"));
  scene.materials[0].doubleSided = true;
  const DrawList list = listOf(scene, {});
  ASSERT_EQ(list.items.size(), 1u);
  EXPECT_EQ(list.items[0].faces, FaceSide::both);
}

// Alpha is coverage in every program.
TEST(DrawList, EveryProgramBlends) {
  const Scene scene = glint::test::sceneOf(glint::test::quad(), blended("b"));
  for (const glint::Shading shading :
       {glint::Shading::flat, glint::Shading::gouraud, glint::Shading::phong,
        glint::Shading::blinnPhong, glint::Shading::environment}) {
    Look look;
    look.shading = shading;
    EXPECT_TRUE(listOf(scene, look).items.at(0).blended);
    Scene solid = scene;
    solid.materials[0].alpha = 1;
    EXPECT_FALSE(listOf(solid, look).items.at(0).blended);
    solid.meshes[0].colors.assign(solid.meshes[0].positions.size(), glm::vec4(1));
    EXPECT_FALSE(listOf(solid, look).items.at(0).blended);
    solid.meshes[0].colors.back().a = 0.99f;
    EXPECT_TRUE(listOf(solid, look).items.at(0).blended);
  }
}

TEST(DrawList, MaterialsAndCamerasThatDoNotExistAreRefused) {
  const Scene scene = glint::test::sceneOf(glint::test::quad());
  Look look;
  look.material["x"].exponent = 1;
  EXPECT_THROW(listOf(scene, look), glint::InputError);
  look = {};
  look.cameraIndex = 0;
  EXPECT_THROW(listOf(scene, look), glint::InputError);
}

TEST(MaterialBlocks, HoldTheEditedNumbers) {
  Scene scene = glint::test::sceneOf(
      glint::test::quad(), glint::test::materialOf(0.9, 0.8, 0.5, 20, 0.25, {0.1, 0.2, 0.3}));
  scene.materials[0].alpha = 0.5;
  scene.materials[0].alphaCutoff = 0.75;
  scene.materials[0].emission = {1, 2, 3};
  scene.materials[0].shading.transmission = 0.625;
  Look look;
  look.material[""].specular = 0.125;
  look.blinnFactor = 3;
  for (glint::Shading shading :
       {glint::Shading::flat, glint::Shading::gouraud, glint::Shading::phong,
        glint::Shading::blinnPhong, glint::Shading::environment}) {
    look.shading = shading;
    const glint::MaterialBlock block = listOf(scene, look).items.at(0).materialBlock;
    const bool blinn =
        shading == glint::Shading::blinnPhong || shading == glint::Shading::environment;
    EXPECT_EQ(block.ambient, 0.9f);
    EXPECT_EQ(block.diffuse, 0.8f);
    EXPECT_EQ(block.specular, 0.125f);
    EXPECT_EQ(block.exponent, blinn ? 60.0f : 20.0f);
    EXPECT_EQ(block.color, glm::vec3(0.1f, 0.2f, 0.3f));
    EXPECT_EQ(block.alpha, 0.5f);
    EXPECT_EQ(block.emission, glm::vec3(1, 2, 3));
    EXPECT_EQ(block.alphaCutoff, 0.75f);
    EXPECT_EQ(block.metalness, 0.25f);
    EXPECT_EQ(block.transmission, 0.625f);
  }
}

// n2 - 1 with n = n2 / n1: the difference is formed in double, so close indices keep their digits.
TEST(MaterialBlocks, IndicesKeepTheirDifference) {
  Scene scene = glint::test::sceneOf(glint::test::quad());
  scene.materials[0].shading.ior = 1.5 + 1e-9;
  Look look;
  look.shading = glint::Shading::environment;
  look.mediumIor = 1.5;
  const glint::MaterialBlock block = listOf(scene, look).items.at(0).materialBlock;
  const double n = (1.5 + 1e-9) / 1.5, d = ((1.5 + 1e-9) - 1.5) / 1.5;
  EXPECT_NEAR(block.entering.x, d * (2 + d), 2 * half * d * 2);
  EXPECT_NEAR(block.entering.y, n * n, 2 * half);
  EXPECT_EQ(block.entering.z, 0);  // no critical angle from the thinner side
  EXPECT_EQ(block.entering.w, 0);
  const double back = (1.5 - (1.5 + 1e-9)) / (1.5 + 1e-9);
  EXPECT_NEAR(block.leaving.x, back * (2 + back), 2 * half * d * 2);
  // The critical cosine sqrt(1 - 1/n^2) as two floats: together accurate to a relative 2^-48.
  const double critical = std::sqrt(-back * (2 + back));
  EXPECT_NEAR(double(block.leaving.z) + double(block.leaving.w), critical,
              critical * half * half * 4);
  EXPECT_NE(block.leaving.w, 0);
}

TEST(LightEntries, AreInEyeSpaceInTheOrderOfTheShaders) {
  Look look = glint::test::parallelLook({1, 0, 0});  // looks along -X: eye +X is world -Z
  Light spot = glint::test::directional({0, -2, 0}, {1, 2, 3});
  spot.type = Light::Type::spot;
  spot.position = {4, 3, 0};
  spot.innerAngle = 20;
  spot.outerAngle = 60;
  Light point = glint::test::directional({0, 0, 0});
  point.type = Light::Type::point;
  point.position = {0, 0, -8};
  Light camera = glint::test::directional({0, 0, 1});
  camera.type = Light::Type::camera;
  look.light = {spot, point, glint::test::directional({0, 5, 0}), camera,
                glint::test::directional({1, 0, 0}, glm::dvec3(0))};
  const DrawList list = listOf(glint::test::sceneOf(glint::test::quad()), look);
  ASSERT_EQ(list.lights.size(), 4u);  // the black one is left out
  const double unit = list.camera.unit;
  const auto expectVector = [](const glm::vec3& v, const glm::dvec3& w) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(v[i], w[i], 4 * half * (1 + std::abs(w[i])));
  };
  expectVector(list.lights[0].position, {0, 1, 0});
  expectVector(list.lights[0].halfway, {0, 1, 1});  // L + V
  expectVector(list.lights[1].position, {0, 0, 1});
  expectVector(list.lights[1].halfway, {0, 0, 2});
  // The eye is at (4, 0, 0), its right is -Z, its back +X.
  expectVector(list.lights[2].position, glm::dvec3(8, 0, -4) / unit);
  expectVector(list.lights[3].position, glm::dvec3(0, 3, 0) / unit);
  expectVector(list.lights[3].axis, {0, -1, 0});
  EXPECT_NEAR(list.lights[3].cosOuter, 0.5, half);
  EXPECT_NEAR(list.lights[3].coneScale, 1 / (std::cos(20 * degrees) - 0.5), 4 * half);
  EXPECT_EQ(list.lights[3].intensity, glm::vec3(1, 2, 3));
}

TEST(LightEntries, HoldTheHalfVectorForBlinnAndNothingWhereItIsUndefined) {
  Look look = glint::test::parallelLook();
  look.shading = glint::Shading::blinnPhong;
  look.light = {glint::test::directional({1, 0, 0}), glint::test::directional({0, 0, -1})};
  const DrawList list = listOf(glint::test::sceneOf(glint::test::quad()), look);
  EXPECT_NEAR(list.lights.at(0).halfway.x, std::sqrt(0.5), half);
  EXPECT_NEAR(list.lights.at(0).halfway.z, std::sqrt(0.5), half);
  EXPECT_EQ(list.lights.at(1).halfway, glm::vec3(0));
}

TEST(LightEntries, ExtremeDistancesKeepTheirDirection) {
  Look look = glint::test::parallelLook();
  for (double distance : {1e-30, 1e30}) {
    Light point = glint::test::directional({0, 0, 0});
    point.type = Light::Type::point;
    point.position = glm::dvec3(0, 0, 4) + glm::dvec3(3, 4, 0) * distance;
    look.light = {point, glint::test::directional(glm::dvec3(3, 4, 0) * distance)};
    const DrawList list = listOf(glint::test::sceneOf(glint::test::quad()), look);
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(std::isfinite(list.lights.at(1).position[i]));
    if (distance > 1) {
      EXPECT_NEAR(list.lights[1].position.x / list.lights[1].position.y, 0.75, 2 * half);
    }
    EXPECT_NEAR(list.lights.at(0).position.x, 0.6, half);
    EXPECT_NEAR(list.lights.at(0).position.y, 0.8, half);
  }
}

TEST(LightEntries, AreAsManyAsTheVariantsCount) {
  Look look;
  Light black = glint::test::directional({1, 0, 0}, glm::dvec3(0)), point = black;
  point.type = Light::Type::point;
  point.intensity = {0, 0, 1};
  look.light = {black, point, glint::test::directional({0, 1, 0})};
  const DrawList list =
      listOf(glint::test::sceneOf(glint::test::quad(), glint::test::materialOf(1, 1, 1, 1)), look);
  const glint::Variant& v = list.items.at(0).variant;
  EXPECT_EQ(std::size_t(v.directionalLights + v.pointLights + v.spotLights), list.lights.size());
}

// Turning the environment by 90 degrees about +Y moves what was at +Z to +X.
TEST(Frame, EnvironmentTurnsAboutY) {
  Look look = glint::test::parallelLook();
  look.environmentRotation = 90;
  const DrawList list = listOf(glint::test::sceneOf(glint::test::quad()), look);
  const glm::vec3 seen = glm::mat3(list.frame.worldFromEye) * glm::vec3(1, 0, 0);
  EXPECT_NEAR(seen.z, 1, half);
  EXPECT_NEAR(seen.x, 0, half);
}

}  // namespace glint::test::draw_list_test
