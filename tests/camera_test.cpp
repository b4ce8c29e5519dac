// Framing and projection compared with the formulas of the design.

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "files.h"
#include "glint/image/error.h"
#include "glint/scene/camera.h"
#include "looks.h"
#include "scenes.h"

namespace glint::test::camera_test {

// About ten operations in double on numbers around 1.
constexpr double tight = 1e-14;

Scene sphereAt(const glm::dvec3& center, double radius) {
  return glint::test::sceneOf(
      glint::test::sphere(32, 16), {},
      glint::test::translation(center) * glint::test::scaling(glm::dvec3(radius)));
}

Camera framed(const Look& look, const Bounds& bounds) { return cameraFor(Scene{}, bounds, look); }

void expectNear(const glm::dvec3& a, const glm::dvec3& b, double tolerance) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], tolerance) << "component " << i;
}

void expectSound(const Camera& camera) {
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(std::isfinite(camera.eye[i]));
    for (int j = 0; j < 3; ++j)
      EXPECT_NEAR(glm::dot(camera.axes[i], camera.axes[j]), i == j ? 1 : 0, tight);
  }
  EXPECT_NEAR(glm::dot(glm::cross(camera.axes[0], camera.axes[1]), camera.axes[2]), 1, tight);
  EXPECT_GT(camera.near, 0);
  EXPECT_GT(camera.far, camera.near);
  EXPECT_TRUE(std::isfinite(camera.far));
  EXPECT_GT(camera.halfHeight, 0);
  EXPECT_TRUE(std::isfinite(camera.halfHeight));
  EXPECT_EQ(camera.unit, std::exp2(std::round(std::log2(camera.unit))));
  const glm::dmat4 p = glint::projection(camera, {0, 0}, {1, 1}, true);
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) EXPECT_TRUE(std::isfinite(p[i][j]));
}

glm::dvec3 ndc(const glm::dmat4& m, const glm::dvec3& eye) {
  const glm::dvec4 clip = m * glm::dvec4(eye, 1);
  return glm::dvec3(clip) / clip.w;
}

TEST(Bounds, AreTheBoxesCentreAndTheFarthestVertex) {
  const glm::dvec3 center(1, -2, 3);
  const Bounds bounds = glint::boundsOf(sphereAt(center, 2));
  expectNear(bounds.center, center, 1e-6);  // float positions
  EXPECT_NEAR(bounds.radius, 2, 1e-6);
  // The corner of a box is the farthest vertex; a vertex that no triangle uses is ignored.
  glint::Mesh mesh = glint::test::quad({0, 0, 1}, 1);
  mesh.positions.emplace_back(100, 0, 0);
  EXPECT_NEAR(glint::boundsOf(glint::test::sceneOf(mesh)).radius, std::sqrt(2), tight);
}

TEST(Bounds, OfNothingOrOnePointHaveNoRadius) {
  EXPECT_EQ(glint::boundsOf(Scene{}).radius, 0);
  glint::Mesh mesh = glint::test::quad();
  mesh.indices = {1, 1, 1};
  const Bounds bounds = glint::boundsOf(glint::test::sceneOf(mesh));
  EXPECT_EQ(bounds.radius, 0);
  expectNear(bounds.center, {2, -2, 0}, 0);
}

TEST(Bounds, NeitherOverflowNorUnderflow) {
  for (double scale : {1e-200, 1e-20, 1e20, 1e200}) {
    const Bounds bounds = glint::boundsOf(sphereAt({0, 0, 0}, scale));
    EXPECT_NEAR(bounds.radius / scale, 1, 1e-6);
  }
}

TEST(Framing, SeesTheSphereFromTheRightAndAbove) {
  const Bounds bounds{{1, 2, 3}, 5};
  const Camera camera = framed(Look{}, bounds);
  const double distance = 5 / (0.9 * std::sin(15 * degrees));
  const glm::dvec3 toEye(std::sin(30 * degrees) * std::cos(20 * degrees), std::sin(20 * degrees),
                         std::cos(30 * degrees) * std::cos(20 * degrees));
  expectNear(camera.eye, bounds.center + toEye * distance, 100 * tight);
  expectNear(camera.axes[2], toEye, tight);
  EXPECT_NEAR(camera.axes[0].y, 0, tight);  // level
  EXPECT_GT(camera.axes[1].y, 0);
  EXPECT_NEAR(camera.halfHeight, std::tan(15 * degrees), tight);
  EXPECT_FALSE(camera.orthographic);
  EXPECT_EQ(camera.aspect, 1);
  expectSound(camera);
}

TEST(Framing, FitsTheSmallerSideOfThePicture) {
  const Bounds bounds{{0, 0, 0}, 1};
  Look look;
  look.cameraViewAngle = 40;
  look.resolution = {1600, 900};
  EXPECT_NEAR(glm::length(framed(look, bounds).eye), 1 / (0.9 * std::sin(20 * degrees)),
              10 * tight);
  look.resolution = {300, 900};
  // Horizontally, the half angle's tangent is the vertical one's times the aspect.
  const double half = std::atan(std::tan(20 * degrees) / 3);
  EXPECT_NEAR(glm::length(framed(look, bounds).eye), 1 / (0.9 * std::sin(half)), 100 * tight);
  look.cameraZoomFactor = 0.45;
  EXPECT_NEAR(glm::length(framed(look, bounds).eye), 1 / (0.45 * std::sin(half)), 100 * tight);
}

// In perspective the zoom factor is the ratio of sines: the sphere's outline appears at the angle
// whose sine is r / distance = zoom sin(a'/2).
TEST(Framing, KeepsTheSphereInsideThePicture) {
  Look look;
  const Camera camera = framed(look, {{0, 0, 0}, 1});
  const double outline = std::asin(1 / glm::length(camera.eye));
  EXPECT_LT(std::tan(outline), camera.halfHeight);
  EXPECT_GT(std::tan(outline), 0.85 * camera.halfHeight);
}

TEST(Framing, OrthographicHalfHeightIsDistanceTimesTangent) {
  Look look;
  look.cameraOrthographic = true;
  look.cameraPosition = glm::dvec3(0, 0, 7);
  look.cameraFocalPoint = glm::dvec3(0, 0, 1);
  look.cameraViewAngle = 50;
  const Camera camera = framed(look, {{0, 0, 0}, 1});
  EXPECT_TRUE(camera.orthographic);
  EXPECT_NEAR(camera.halfHeight, 6 * std::tan(25 * degrees), 10 * tight);
}

// As in VTK, and so in F3D: azimuth turns about the up vector, to the camera's right; elevation
// upwards.
TEST(Framing, AzimuthAndElevationTurnAsInF3d) {
  Look look;
  look.cameraPosition = glm::dvec3(1, 2, 3 + 4);
  look.cameraFocalPoint = glm::dvec3(1, 2, 3);
  const Bounds bounds{{1, 2, 3}, 1};
  look.cameraAzimuthAngle = 90;
  expectNear(framed(look, bounds).eye, {5, 2, 3}, 10 * tight);
  look.cameraAzimuthAngle = 0;
  look.cameraElevationAngle = 90;
  expectNear(framed(look, bounds).eye, {1, 6, 3}, 10 * tight);
  expectNear(framed(look, bounds).axes[1], {0, 0, -1}, 10 * tight);  // what was ahead is now up
  look.cameraElevationAngle = -30;
  expectNear(framed(look, bounds).eye,
             {1, 2 - 4 * std::sin(30 * degrees), 3 + 4 * std::cos(30 * degrees)}, 10 * tight);
  // Both together are the default view.
  look.cameraAzimuthAngle = 30;
  look.cameraElevationAngle = 20;
  const Camera turned = framed(look, bounds), standard = framed(Look{}, bounds);
  for (int i = 0; i < 3; ++i) expectNear(turned.axes[i], standard.axes[i], 10 * tight);
}

TEST(Framing, DirectionLooksThatWay) {
  Look look;
  look.cameraDirection = glm::dvec3(0, -3, 0);
  const Camera camera = framed(look, {{1, 1, 1}, 2});
  expectNear(camera.axes[2], {0, 1, 0}, tight);
  EXPECT_NEAR(camera.eye.x, 1, tight);
  EXPECT_GT(camera.eye.y, 3);
  look.cameraPosition = glm::dvec3(9, 9, 9);
  expectNear(framed(look, {{1, 1, 1}, 2}).eye, {9, 9, 9}, 0);
  expectNear(framed(look, {{1, 1, 1}, 2}).axes[2], {0, 1, 0}, tight);
}

TEST(Framing, UpIsUpwards) {
  Look look;
  look.cameraPosition = glm::dvec3(0, 0, 4);
  look.cameraViewUp = glm::dvec3(1, 0, 0.3);
  expectNear(framed(look, {{0, 0, 0}, 1}).axes[1], {1, 0, 0}, tight);
}

// G6: the eye at the target, up along the view, no radius. G7, G8: extreme angles and pictures.
TEST(Framing, DegenerateInputsGiveSoundCameras) {
  const Bounds bounds[] = {{{0, 0, 0}, 0},
                           {{1, 2, 3}, 1},
                           {{0, 0, 0}, 1e-30},
                           {{1e20, 0, 0}, 1e20},
                           {{1e7, 1e7, 1e7}, 1}};
  for (const Bounds& b : bounds) {
    Look look;
    expectSound(framed(look, b));
    look.cameraPosition = b.center;
    expectSound(framed(look, b));  // inside the object, and at the focal point
    look.cameraFocalPoint = b.center;
    expectSound(framed(look, b));
    for (const glm::dvec3 axis :
         {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, -1), glm::dvec3(1, 1, 1)}) {
      Look along;
      along.cameraDirection = axis;
      along.cameraViewUp = axis;
      expectSound(framed(along, b));
      along.cameraViewUp = -axis;
      along.cameraElevationAngle = 90;
      expectSound(framed(along, b));
    }
    for (double angle : {1e-5, 0.001, 179.0, 179.9})
      for (bool orthographic : {false, true})
        for (glm::ivec2 resolution :
             {glm::ivec2(1, 1), glm::ivec2(16384, 1), glm::ivec2(1, 16384)}) {
          Look extreme;
          extreme.cameraViewAngle = angle;
          extreme.cameraOrthographic = orthographic;
          extreme.resolution = resolution;
          expectSound(framed(extreme, b));
        }
  }
}

TEST(Framing, ObjectsLieBetweenNearAndFar) {
  for (double radius : {1e-20, 1.0, 1e20}) {
    const Bounds bounds{glm::dvec3(3, 4, 5) * radius, radius};
    const Camera camera = framed(Look{}, bounds);
    const double center = glm::dot(camera.eye - bounds.center, camera.axes[2]);
    EXPECT_LT(camera.near, center - radius);
    EXPECT_GT(camera.far, center + radius);
  }
}

TEST(Framing, FileCamerasStandAsTheFileSays) {
  Scene scene = sphereAt({0, 0, 0}, 1);
  glint::FileCamera file;
  file.world = glint::test::translation({0, 0, 9}) *
               glint::test::scaling(glm::dvec3(3));  // a camera's scale is ignored
  file.viewAngle = 0.7;
  scene.cameras.push_back(file);
  file.orthographic = true;
  file.halfHeight = 2.5;
  scene.cameras.push_back(file);
  Look look;
  look.cameraIndex = 0;
  const Bounds bounds = glint::boundsOf(scene);
  Camera camera = cameraFor(scene, bounds, look);
  expectNear(camera.eye, {0, 0, 9}, 0);
  expectNear(camera.axes[2], {0, 0, 1}, tight);
  EXPECT_NEAR(camera.halfHeight, std::tan(0.35), tight);
  EXPECT_FALSE(camera.orthographic);
  look.cameraIndex = 1;
  camera = cameraFor(scene, bounds, look);
  EXPECT_TRUE(camera.orthographic);
  EXPECT_NEAR(camera.halfHeight, 2.5, tight);
  look.cameraIndex = 2;
  EXPECT_THAT(test::messageOf([&] { cameraFor(scene, bounds, look); }),
              testing::HasSubstr("--camera-index 2"));
  EXPECT_THROW(cameraFor(Scene{}, {}, look), glint::InputError);
}

// u = fx X / Z + cx and v = fy Y / Z + cy with X to the right, Y down and Z ahead, as in camera
// calibrations.
TEST(Intrinsics, PutPointsWhereTheLensDoes) {
  Look look;
  look.resolution = {640, 360};
  look.cameraIntrinsics = glm::dvec4(700, 820, 290, 230);
  const Camera camera = framed(look, {{0, 0, 0}, 1});
  expectSound(camera);
  for (const glm::dvec3& p :
       {glm::dvec3(0, 0, 4), glm::dvec3(0.4, -0.3, 3), glm::dvec3(-2, 1, 9)}) {
    for (const bool reversed : {false, true}) {
      const glm::dmat4 m = glint::projection(camera, {0, 0}, {1, 1}, reversed);
      const glm::dvec3 at = ndc(m, glm::dvec3(p.x, -p.y, -p.z) / camera.unit);
      // Pixel coordinates are some 1e3 times larger than numbers around 1.
      EXPECT_NEAR((at.x + 1) / 2 * 640, 700 * p.x / p.z + 290, 1e3 * tight);
      EXPECT_NEAR((1 - at.y) / 2 * 360, 820 * p.y / p.z + 230, 1e3 * tight);
    }
  }
  // In a part of the picture, the same pixel.
  const glm::dmat4 part = glint::projection(camera, {0.25, 0.5}, {0.5, 1}, true);
  const glm::dvec3 at = ndc(part, glm::dvec3(-0.1, 0.05, -1) / camera.unit);
  EXPECT_NEAR((at.x + 1) / 2 * 160, 700 * -0.1 + 290 - 160, 1e3 * tight);
  EXPECT_NEAR((1 - at.y) / 2 * 180, 820 * -0.05 + 230, 1e3 * tight);
}

TEST(Intrinsics, FrameTheSphereOnAllFourSides) {
  for (const glm::dvec4& lens :
       {glm::dvec4(700, 820, 290, 230), glm::dvec4(300, 300, 60, 180), glm::dvec4(500, 90, 320, 20),
        glm::dvec4(700, 700, 500, 180), glm::dvec4(700, 700, 320, 300)}) {
    Look look;
    look.resolution = {640, 360};
    look.cameraIntrinsics = lens;
    const double distance = glm::length(framed(look, {{0, 0, 0}, 1}).eye);
    const double nearest = std::min(
        {lens.z / lens.x, (640 - lens.z) / lens.x, lens.w / lens.y, (360 - lens.w) / lens.y});
    EXPECT_NEAR(distance, 1 / (0.9 * std::sin(std::atan(nearest))), 100 * tight);
  }
  Look look;  // a principal point outside of the picture
  look.cameraIntrinsics = glm::dvec4(1000, 1000, -1e7, 1e7);
  expectSound(framed(look, {{0, 0, 0}, 1}));
  // The same lens as a view angle.
  look.cameraIntrinsics = glm::dvec4(1024, 1024, 512, 512);
  Look angle;
  angle.cameraViewAngle = 2 * std::atan(0.5) / degrees;
  expectNear(framed(look, {{0, 0, 0}, 1}).eye, framed(angle, {{0, 0, 0}, 1}).eye, 10 * tight);
}

TEST(Intrinsics, AreNotOfParallelProjections) {
  Scene scene;
  scene.cameras.resize(1);
  scene.cameras[0].orthographic = true;
  Look look;
  look.cameraIntrinsics = glm::dvec4(1000, 1000, 512, 512);
  look.cameraOrthographic = true;
  EXPECT_THROW(cameraFor(scene, {}, look), glint::InputError);
  look.cameraOrthographic = false;
  look.cameraIndex = 0;
  EXPECT_THROW(cameraFor(scene, {}, look), glint::InputError);
  // For a perspective camera of the file they replace the lens, and nothing else.
  scene.cameras[0].orthographic = false;
  scene.cameras[0].world = glint::test::translation({1, 2, 9});
  const Camera camera = cameraFor(scene, {}, look);
  expectNear(camera.eye, {1, 2, 9}, 0);
  EXPECT_NEAR(camera.halfHeight, 0.512, tight);
}

TEST(Projection, ReversedMapsNearToOneAndFarToZero) {
  for (bool orthographic : {false, true}) {
    Look look;
    look.cameraOrthographic = orthographic;
    look.clippingRange = glm::dvec2(0.25, 4000);
    const Camera camera = framed(look, {{0, 0, 0}, 3});
    const double near = camera.near / camera.unit, far = camera.far / camera.unit;
    const glm::dmat4 reversed = glint::projection(camera, {0, 0}, {1, 1}, true);
    const glm::dmat4 plain = glint::projection(camera, {0, 0}, {1, 1}, false);
    // far times a relative rounding of 2^-53, divided by far: at most a few ulps of 1.
    EXPECT_NEAR(ndc(reversed, {0, 0, -near}).z, 1, 1e-14);
    EXPECT_NEAR(ndc(reversed, {0, 0, -far}).z, 0, 1e-14);
    EXPECT_NEAR(ndc(plain, {0, 0, -near}).z, -1, 1e-11);
    EXPECT_NEAR(ndc(plain, {0, 0, -far}).z, 1, 1e-11);
    const double middle = 0.5 * (near + far);
    EXPECT_GT(ndc(reversed, {0, 0, -middle}).z, ndc(reversed, {0, 0, -far}).z);
  }
}

TEST(Projection, PictureEdgesAreTheViewAngles) {
  Look look;
  look.resolution = {200, 100};
  look.cameraViewAngle = 60;
  const Camera camera = framed(look, {{0, 0, 0}, 1});
  const glm::dmat4 m = glint::projection(camera, {0, 0}, {1, 1}, true);
  const double half = std::tan(30 * degrees);
  expectNear(ndc(m, {2 * half * 5, half * 5, -5}) * glm::dvec3(1, 1, 0), {1, 1, 0}, tight);
  expectNear(ndc(m, {-2 * half * 3, 0, -3}) * glm::dvec3(1, 1, 0), {-1, 0, 0}, tight);
}

TEST(Projection, OfTilesIsThatOfTheWhole) {
  for (bool orthographic : {false, true}) {
    Look look;
    look.cameraOrthographic = orthographic;
    look.resolution = {640, 360};
    const Camera camera = framed(look, {{0, 0, 0}, 1});
    const glm::dmat4 whole = glint::projection(camera, {0, 0}, {1, 1}, true);
    for (const auto& [lower, upper] : {std::pair(glm::dvec2(0, 0), glm::dvec2(0.25, 0.5)),
                                       std::pair(glm::dvec2(0.125, 0.4), glm::dvec2(0.9, 0.7)),
                                       std::pair(glm::dvec2(0.999, 0.5), glm::dvec2(1, 1))}) {
      const glm::dmat4 tile = glint::projection(camera, lower, upper, true);
      for (const glm::dvec3 point :
           {glm::dvec3(0.1, -0.2, -1), glm::dvec3(-0.5, 0.3, -0.7), glm::dvec3(0.2, 0.2, -1.4)}) {
        const glm::dvec3 a = ndc(whole, point), b = ndc(tile, point);
        for (int i = 0; i < 2; ++i) {
          // Maps the whole picture's coordinate to the tile's, from -1 to 1; rounding is magnified
          // by the width of the picture over that of the tile.
          const double size = upper[i] - lower[i];
          EXPECT_NEAR(b[i], ((a[i] + 1) / 2 - lower[i]) / size * 2 - 1, 1e-14 / size);
        }
        EXPECT_EQ(a.z, b.z);
      }
    }
  }
}

TEST(Camera, PowersOfTwoChangeNothingButTheUnit) {
  const Bounds bounds{{0.3, -0.2, 0.5}, 1.7};
  const Camera camera = framed(Look{}, bounds);
  for (int k : {-120, -3, 1, 64}) {
    const double s = std::exp2(k);
    const Camera scaled = framed(Look{}, {bounds.center * s, bounds.radius * s});
    EXPECT_EQ(scaled.eye, camera.eye * s);
    EXPECT_EQ(scaled.axes, camera.axes);
    EXPECT_EQ(scaled.unit, camera.unit * s);
    EXPECT_EQ(scaled.near, camera.near * s);
    EXPECT_EQ(scaled.far, camera.far * s);
    EXPECT_EQ(glint::projection(scaled, {0, 0}, {1, 1}, true),
              glint::projection(camera, {0, 0}, {1, 1}, true));
  }
}

// A look can hold the camera of any file, and reads it again: of a turntable, and of the window
// when the model moves.
TEST(DefiniteLook, CanBeSavedForAnyCameraOfAFile) {
  const Bounds bounds{{0.3, -0.2, 0.5}, 1.7};
  Scene scene;
  const auto add = [&](double ahead) -> glint::FileCamera& {
    scene.cameras.emplace_back().world =
        glint::test::translation(bounds.center + glm::dvec3(0, 0, ahead));
    return scene.cameras.back();
  };
  for (const double angle : {1e-12, 1e-8, 1e-3, 3.14, std::nextafter(std::numbers::pi, 0.0)})
    add(5).viewAngle = angle;
  for (const double ahead : {-1.0, 0.0, 1e-300, 1e-14, 1e-5, 1.0, 1e9})
    for (const bool orthographic : {false, true}) add(ahead).orthographic = orthographic;
  for (const double halfHeight : {1e-12, 1e12}) {
    glint::FileCamera& camera = add(3);
    camera.orthographic = true;
    camera.halfHeight = halfHeight;
  }
  add(5).far = 0.25;  // in front of the model
  for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
    SCOPED_TRACE(i);
    Look look;
    look.cameraIndex = int(i);
    const Camera before = cameraFor(scene, bounds, look);
    const Look turned = glint::turnedLook(look, scene, bounds, 0);
    ASSERT_FALSE(turned.cameraIndex);
    ASSERT_EQ(test::lookOf(glint::saveLook(turned)), turned);
    const Camera after = cameraFor(scene, bounds, turned);
    expectNear(after.eye, before.eye, 1e9 * tight);
    // The eye, rounded by 4e-16 near the model, and the focal point are at least 1.7e-3 apart.
    for (int k = 0; k < 3; ++k) expectNear(after.axes[k], before.axes[k], 1e-12);
    EXPECT_EQ(after.orthographic, before.orthographic);
    const double angle = 2 * std::atan(before.halfHeight) / degrees;
    if (after.orthographic || (angle > glint::smallestViewAngle && angle < 179.999))
      EXPECT_NEAR(after.halfHeight / before.halfHeight, 1, 1e-9);
    EXPECT_NEAR(after.near / before.near, 1, 1e-9);
    EXPECT_NEAR(after.far / before.far, 1, 1e-9);
  }
}

// Eye and axes turn rigidly about the axis +Y through the centre, however the camera was specified.
TEST(TurnedLook, GoesRoundTheCentre) {
  const Bounds bounds{{0.3, -0.2, 0.5}, 1.7};
  Scene scene;
  scene.cameras.resize(2);
  scene.cameras[0].world = glint::test::translation({3, 1, 2}) * glint::test::rotation(0.4);
  scene.cameras[1] = scene.cameras[0];
  scene.cameras[1].orthographic = true;
  scene.cameras[1].halfHeight = 0.8;
  std::vector<Look> looks(9);
  looks[8].cameraIndex = 0;
  looks[8].cameraIntrinsics = {700, 800, 300, 600};
  looks[1].cameraPosition = {1, 2, 6};
  looks[2].cameraPosition = {1, 2, 6};
  looks[2].cameraDirection = {0.1, -0.3, -1};
  looks[3].cameraFocalPoint = {1, 0.5, 0};
  looks[3].cameraOrthographic = true;
  looks[4].cameraViewUp = {1, 1, 0};
  looks[4].cameraAzimuthAngle = 20;
  looks[4].cameraElevationAngle = -15;
  looks[5].cameraIndex = 0;
  looks[6].cameraIndex = 1;
  looks[7].cameraIndex = 1;
  looks[7].cameraViewAngle = 50;
  for (const Look& look : looks)
    for (const double angle : {0.0, 30.0, 90.0, 200.0}) {
      const double c = std::cos(angle * degrees), s = std::sin(angle * degrees);
      const auto turn = [&](const glm::dvec3& v) {
        return glm::dvec3(c * v.x + s * v.z, v.y, c * v.z - s * v.x);
      };
      const Camera before = cameraFor(scene, bounds, look);
      const Camera after = cameraFor(scene, bounds, glint::turnedLook(look, scene, bounds, angle));
      SCOPED_TRACE(testing::Message() << "look " << &look - looks.data() << ", " << angle);
      // Distances here are below 16.
      expectNear(after.eye - bounds.center, turn(before.eye - bounds.center), 16 * tight);
      for (int i = 0; i < 3; ++i) expectNear(after.axes[i], turn(before.axes[i]), 16 * tight);
      EXPECT_EQ(after.orthographic, before.orthographic);
      EXPECT_NEAR(after.halfHeight, before.halfHeight, tight);
      EXPECT_NEAR(after.aspect, before.aspect, tight);
      expectNear({after.shift, 0}, {before.shift, 0}, tight);
      EXPECT_NEAR(after.near, before.near, 16 * tight);
      EXPECT_NEAR(after.far, before.far, 16 * tight);
    }
}

}  // namespace glint::test::camera_test
