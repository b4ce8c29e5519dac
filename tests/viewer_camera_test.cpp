#include <gtest/gtest.h>

#include <cmath>

#include "viewer/camera_control.h"
#include "viewer/picking.h"

namespace glint::viewer {
namespace viewer_camera_test {

// A square of two triangles in the plane z = 0, facing +Z, with corners at +-1.
Scene square() {
  Scene scene;
  scene.materials.resize(1);
  scene.materials[0].name = "paint";
  Mesh mesh;
  mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  mesh.normals.assign(4, {0, 0, 1});
  mesh.indices = {0, 1, 2, 0, 2, 3};
  scene.meshes.push_back(mesh);
  scene.instances.push_back({0, glm::dmat4(1)});
  return scene;
}

void expectNear(const glm::dvec3& a, const glm::dvec3& b, double tolerance) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], tolerance) << "component " << i;
}

TEST(CameraControl, APoseIsThePictureItWasMadeOf) {
  const Scene scene = square();
  const Bounds bounds = boundsOf(scene);
  for (const bool orthographic : {false, true}) {
    Look look;
    look.cameraAzimuthAngle = 20;
    look.cameraElevationAngle = -10;
    look.cameraOrthographic = orthographic;
    Look posed = look;
    setPose(posed, poseOf(scene, bounds, look));
    const Camera a = cameraFor(scene, bounds, look), b = cameraFor(scene, bounds, posed);
    expectNear(a.eye, b.eye, 1e-12);
    for (int i = 0; i < 3; ++i) expectNear(a.axes[i], b.axes[i], 1e-12);
    EXPECT_NEAR(a.halfHeight, b.halfHeight, 1e-12);
    EXPECT_EQ(a.orthographic, b.orthographic);
  }
}

TEST(CameraControl, OrbitKeepsDistanceAndStopsAtThePoles) {
  Pose pose;
  pose.position = {0, 0, 5};
  const Pose turned = orbited(pose, 90, 0);
  expectNear(turned.position, {5, 0, 0}, 1e-12);
  const Pose above = orbited(pose, 0, 1000);
  EXPECT_NEAR(glm::length(above.position), 5, 1e-12);
  EXPECT_NEAR(above.position.y, 5 * std::cos(0.5 * 3.14159265358979 / 180), 1e-9);
  expectNear(orbited(orbited(pose, 33, 12), -33, -12).position, pose.position, 1e-12);
}

TEST(CameraControl, PanMovesTheFocalPlaneWithTheHand) {
  Pose pose;
  pose.position = {0, 0, 5};
  const double height = 2 * 5 * std::tan(15 * 3.141592653589793 / 180);
  const Pose moved = panned(pose, 1, 0.5);
  expectNear(moved.focalPoint, {-height, height / 2, 0}, 1e-12);
  expectNear(moved.position - moved.focalPoint, {0, 0, 5}, 1e-12);
}

TEST(CameraControl, DollyKeepsWhatIsUnderTheCursor) {
  const Scene scene = square();
  const Bounds bounds = boundsOf(scene);
  Look look;
  look.resolution = {800, 600};
  look.cameraPosition = {0, 0, 6};
  look.cameraFocalPoint = {0, 0, 0};
  const Pose pose = poseOf(scene, bounds, look);
  const glm::dvec2 pixel(500, 200);
  const glm::dvec2 centered = (pixel - glm::dvec2(400, 300)) * glm::dvec2(2, -2) / 600.0;
  const auto onPlane = [&](const Look& l) {
    const Ray ray = rayThrough(cameraFor(scene, bounds, l), pixel, l.resolution);
    return ray.origin - ray.direction * (ray.origin.z / ray.direction.z);
  };
  const glm::dvec3 before = onPlane(look);
  setPose(look, dollied(pose, 0.5, focalPlanePoint(pose, centered)));
  expectNear(onPlane(look), before, 1e-12);
  EXPECT_NEAR(look.cameraPosition->z, 3, 1e-12);
}

TEST(CameraControl, NoNumberOfStepsGoesThroughThePoint) {
  const Scene scene = square();
  const Bounds bounds = boundsOf(scene);
  for (const bool orthographic : {false, true}) {
    Look look;
    look.resolution = {800, 600};
    look.cameraPosition = {1, 2, 6};
    look.cameraFocalPoint = {0.2, 0, -3};  // behind the surface
    look.cameraOrthographic = orthographic;
    const glm::dvec3 point(0.3, -0.4, 0);
    const auto seenAt = [&] {
      const Camera camera = cameraFor(scene, bounds, look);
      const glm::dvec3 eye = glm::transpose(camera.axes) * (point - camera.eye);
      return glm::dvec2(eye) / (orthographic ? 1 : -eye.z) / camera.halfHeight;
    };
    const glm::dvec2 first = seenAt();
    for (int i = 0; i < 60; ++i) setPose(look, dollied(poseOf(scene, bounds, look), 0.88, point));
    EXPECT_GT(look.cameraPosition->z, 0);
    EXPECT_NEAR(glm::length(*look.cameraPosition - point),
                glm::length(glm::dvec3(1, 2, 6) - point) * std::pow(0.88, 60), 1e-9);
    EXPECT_NEAR(glm::length(seenAt() - first), 0, 1e-6);
  }
}

TEST(CameraControl, APivotStaysWhereItIsSeen) {
  const Scene scene = square();
  const Bounds bounds = boundsOf(scene);
  Look look;
  look.resolution = {800, 600};
  look.cameraPosition = {1, 2, 6};
  look.cameraFocalPoint = {0.2, 0, -3};
  const glm::dvec3 pivot(0.7, -0.4, 0.1);
  const auto seenAt = [&](const Look& l) {
    const Camera camera = cameraFor(scene, bounds, l);
    const glm::dvec3 eye = glm::transpose(camera.axes) * (pivot - camera.eye);
    return glm::dvec3(eye);
  };
  const glm::dvec3 first = seenAt(look);
  const Pose pose = poseOf(scene, bounds, look);
  Look turned = look;
  setPose(turned, orbited(pose, 40, 25, pivot));
  expectNear(seenAt(turned), first, 1e-12);
  EXPECT_GT(glm::length(*turned.cameraPosition - *look.cameraPosition), 1);
  // About the focal point the result is the same as without a pivot.
  setPose(turned, orbited(pose, 40, 25, pose.focalPoint));
  setPose(look, orbited(pose, 40, 25));
  expectNear(*turned.cameraPosition, *look.cameraPosition, 1e-12);
}

TEST(CameraControl, StandardViewsLookTheirWay) {
  const Scene scene = square();
  const Bounds bounds = boundsOf(scene);
  Look look;
  setView(look, StandardView::top);
  expectNear(cameraFor(scene, bounds, look).axes[2], {0, 1, 0}, 1e-12);
  setView(look, StandardView::right);
  expectNear(cameraFor(scene, bounds, look).axes[2], {1, 0, 0}, 1e-12);
  resetCamera(look);
  EXPECT_EQ(look, Look());
}

TEST(Picker, FindsTheTriangleAndThePoint) {
  const Scene scene = square();
  const Picker picker(scene);
  const auto hit = picker.pick(scene, {{0.25, -0.5, 3}, {0, 0, -1}}, false);
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->primitive, 0u);
  expectNear(hit->position, {0.25, -0.5, 0}, 1e-12);
  expectNear(hit->normal, {0, 0, 1}, 1e-12);
  EXPECT_FALSE(hit->backFace);
  EXPECT_FALSE(picker.pick(scene, {{1.5, 0, 3}, {0, 0, -1}}, false));
}

TEST(Picker, PassesThroughWhatIsNotDrawn) {
  Scene scene = square();
  const Ray fromBehind{{0, 0, -3}, {0, 0, 1}};
  EXPECT_FALSE(Picker(scene).pick(scene, fromBehind, false));
  const auto both = Picker(scene).pick(scene, fromBehind, true);
  ASSERT_TRUE(both);
  EXPECT_TRUE(both->backFace);
  scene.materials[0].doubleSided = true;
  EXPECT_TRUE(Picker(scene).pick(scene, fromBehind, false));
  // Mirroring an instance reverses its faces.
  scene = square();
  scene.instances[0].world[2][2] = -1;
  EXPECT_TRUE(Picker(scene).pick(scene, fromBehind, false));
}

TEST(Picker, WorksFarFromTheOrigin) {
  Scene scene = square();
  scene.instances[0].world[3] = {1e8, 1e8, 1e8, 1};
  const auto hit = Picker(scene).pick(scene, {{1e8 + 0.5, 1e8 + 0.25, 1e8 + 3}, {0, 0, -1}}, false);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->position.z, 1e8, 1e-7);
}

}  // namespace viewer_camera_test
}  // namespace glint::viewer
