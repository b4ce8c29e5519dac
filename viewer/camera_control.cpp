#include "camera_control.h"
#include "glint/shading/angles.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace glint::viewer {
namespace {

glm::dvec3 turned(const glm::dvec3& v, const glm::dvec3& axis, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return v * c + glm::cross(axis, v) * s + axis * (glm::dot(axis, v) * (1 - c));
}

struct Axes {
  glm::dvec3 right, up, back;
  double distance;
};

Axes axesOf(const Pose& pose) {
  Axes a;
  const glm::dvec3 away = pose.position - pose.focalPoint;
  a.distance = glm::length(away);
  a.back = a.distance > 0 ? away / a.distance : glm::dvec3(0, 0, 1);
  a.right = glm::cross(pose.up, a.back);
  if (glm::dot(a.right, a.right) < 1e-20)
    a.right =
        glm::cross(std::abs(a.back.z) < 0.9 ? glm::dvec3(0, 0, -1) : glm::dvec3(1, 0, 0), a.back);
  a.right = glm::normalize(a.right);
  a.up = glm::cross(a.back, a.right);
  return a;
}

void clearCamera(Look& look) {
  look.cameraPosition.reset();
  look.cameraFocalPoint.reset();
  look.cameraDirection.reset();
  look.cameraViewUp.reset();
  look.cameraAzimuthAngle = look.cameraElevationAngle = 0;
  look.cameraZoomFactor = Look{}.cameraZoomFactor;
  look.cameraIndex.reset();
}

}  // namespace

Pose poseOf(const Scene& scene, const Bounds& bounds, const Look& look) {
  const Camera camera = cameraFor(scene, bounds, look);
  const glm::dvec3 back = camera.axes[2];
  Pose pose;
  double distance = look.cameraFocalPoint ? glm::dot(camera.eye - *look.cameraFocalPoint, back)
                                          : distanceAhead(camera, bounds);
  if (!(distance > 0)) distance = bounds.radius > 0 ? bounds.radius : 1;
  pose.focalPoint = camera.eye - back * distance;
  pose.orthographic = camera.orthographic;
  if (!camera.orthographic) {
    pose.viewAngle = viewAngleOf(camera.halfHeight);
  } else {
    // The half height of a parallel projection is the distance times the tangent; the eye may be
    // anywhere along the viewing direction.
    pose.viewAngle = look.cameraViewAngle.value_or(30);
    distance = camera.halfHeight / std::tan(pose.viewAngle * radians / 2);
  }
  pose.position = pose.focalPoint + back * distance;
  pose.up = look.cameraViewUp.value_or(glm::dvec3(0, 1, 0));
  // A camera from the file or turned by angles may be rolled, or look along its up vector.
  const Axes axes = axesOf(pose);
  if (glm::dot(axes.up, camera.axes[1]) < 1 - 1e-12) pose.up = camera.axes[1];
  return pose;
}

void setPose(Look& look, const Pose& pose) {
  clearCamera(look);
  look.cameraPosition = pose.position;
  look.cameraFocalPoint = pose.focalPoint;
  if (pose.up != glm::dvec3(0, 1, 0)) look.cameraViewUp = pose.up;
  look.cameraOrthographic = pose.orthographic;
  if (look.cameraIntrinsics) return;  // they determine the angle
  if (pose.viewAngle != 30 || look.cameraViewAngle) look.cameraViewAngle = pose.viewAngle;
}

Pose orbited(const Pose& pose, double right, double upwards, std::optional<glm::dvec3> pivot) {
  Pose moved = pose;
  const Axes axes = axesOf(pose);
  const glm::dvec3 up = glm::normalize(pose.up);
  const double azimuth = right * radians;
  glm::dvec3 back = turned(axes.back, up, azimuth);
  const glm::dvec3 side = turned(axes.right, up, azimuth);
  const double now = std::acos(std::clamp(glm::dot(back, up), -1.0, 1.0));
  const double limit = 0.5 * radians;
  const double wanted = std::clamp(now - upwards * radians, limit, std::numbers::pi - limit);
  back = turned(back, side, wanted - now);
  if (!pivot) {
    moved.position = pose.focalPoint + glm::normalize(back) * axes.distance;
    return moved;
  }
  // The camera's axes turn from (right, up, back) to these; points relative to the pivot turn too.
  const glm::dmat3 was(axes.right, axes.up, axes.back);
  const glm::dmat3 is(side, glm::cross(back, side), back);
  const auto carried = [&](const glm::dvec3& p) {
    return *pivot + is * (glm::transpose(was) * (p - *pivot));
  };
  moved.focalPoint = carried(pose.focalPoint);
  moved.position = moved.focalPoint + glm::normalize(back) * axes.distance;
  return moved;
}

Pose panned(const Pose& pose, double right, double down) {
  const Axes axes = axesOf(pose);
  const double height = 2 * axes.distance * std::tan(pose.viewAngle * radians / 2);
  const glm::dvec3 shift = (axes.up * down - axes.right * right) * height;
  Pose moved = pose;
  moved.position += shift;
  moved.focalPoint += shift;
  return moved;
}

glm::dvec3 focalPlanePoint(const Pose& pose, glm::dvec2 cursor) {
  const Axes axes = axesOf(pose);
  const double half = axes.distance * std::tan(pose.viewAngle * radians / 2);
  return pose.focalPoint + (axes.right * cursor.x + axes.up * cursor.y) * half;
}

Pose dollied(const Pose& pose, double factor, const glm::dvec3& point) {
  const Axes axes = axesOf(pose);
  Pose moved = pose;
  moved.focalPoint = point + (pose.focalPoint - point) * factor;
  moved.position = moved.focalPoint + axes.back * (axes.distance * factor);
  return moved;
}

Pose rolled(const Pose& pose, double angle) {
  const Axes axes = axesOf(pose);
  Pose moved = pose;
  moved.up = turned(axes.up, axes.back, -angle * radians);
  return moved;
}

void setView(Look& look, StandardView view) {
  clearCamera(look);
  glm::dvec3 direction;
  switch (view) {
    case StandardView::front:
      direction = {0, 0, -1};
      break;
    case StandardView::back:
      direction = {0, 0, 1};
      break;
    case StandardView::right:
      direction = {-1, 0, 0};
      break;
    case StandardView::left:
      direction = {1, 0, 0};
      break;
    case StandardView::top:
      direction = {0, -1, 0};
      look.cameraViewUp = {0, 0, -1};
      break;
    case StandardView::bottom:
      direction = {0, 1, 0};
      look.cameraViewUp = {0, 0, 1};
      break;
    case StandardView::isometric:
      direction = {-1, -1, -1};
      break;
  }
  look.cameraDirection = direction;
}

void fit(Look& look, const Scene& scene, const Bounds& bounds) {
  const Pose pose = poseOf(scene, bounds, look);
  const glm::dvec3 direction = -axesOf(pose).back;
  clearCamera(look);
  look.cameraDirection = direction;
  if (pose.up != glm::dvec3(0, 1, 0)) look.cameraViewUp = pose.up;
}

void resetCamera(Look& look) {
  clearCamera(look);
  look.cameraViewAngle.reset();
  look.cameraIntrinsics.reset();
  look.cameraOrthographic = false;
  look.clippingRange.reset();
}

Ray rayThrough(const Camera& camera, glm::dvec2 pixel, glm::ivec2 resolution) {
  const glm::dvec2 at = pixel / glm::dvec2(resolution) * 2.0 - 1.0;
  const glm::dvec2 reach(camera.halfHeight * camera.aspect, camera.halfHeight);
  const glm::dvec2 offset = (glm::dvec2(at.x, -at.y) + camera.shift) * reach;
  const double width = 2 * camera.halfHeight / resolution.y;
  if (camera.orthographic) {
    // Start far enough back that the whole scene is ahead.
    const glm::dvec3 eye = camera.eye + camera.axes[2] * (camera.far - camera.near);
    return {eye + camera.axes[0] * offset.x + camera.axes[1] * offset.y, -camera.axes[2], width, 0};
  }
  return {camera.eye, glm::normalize(camera.axes * glm::dvec3(offset, -1.0)), 0, width};
}

}  // namespace glint::viewer
