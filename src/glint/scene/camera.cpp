#include "glint/scene/camera.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

#include "glint/image/error.h"
#include "glint/image/printable.h"
#include "glint/image/task.h"
#include "glint/shading/angles.h"

namespace glint {
namespace {

// Whether it is invisible: scaled to a point, or fully transparent.
bool isUnseen(const Scene& scene, const Instance& instance) {
  const glm::dmat3 linear(instance.world);
  if (linear == glm::dmat3(0.0)) return true;
  const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
  const Material& material = scene.materials[std::size_t(mesh.material)];
  return (material.alphaMode == AlphaMode::blend && material.alpha == 0) ||
         (material.alphaMode == AlphaMode::mask && material.alpha < material.alphaCutoff);
}

// A growing box.
struct Box {
  glm::dvec3 low{std::numeric_limits<double>::infinity()};
  glm::dvec3 high = -low;
  void add(const glm::dvec3& p) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  void add(const Box& other) {
    low = glm::min(low, other.low);
    high = glm::max(high, other.high);
  }
  bool isEmpty() const { return !(low.x <= high.x); }
};

// The largest squared distance from a point, in units of `scale`, so that huge and tiny models
// neither over- nor underflow.
struct Farthest {
  glm::dvec3 from;
  double scale;
  double square = 0;
  void add(const glm::dvec3& p) {
    const glm::dvec3 d = (p - from) / scale;
    square = std::max(square, glm::dot(d, d));
  }
  void add(const Farthest& other) { square = std::max(square, other.square); }
};

// Adds every vertex of the visible instances or, if `unseen`, of the invisible ones.
template <typename Sum>
Sum overVertices(const Scene& scene, bool unseen, const Sum& none) {
  Sum sum = none;
  std::mutex joining;
  for (const Instance& instance : scene.instances) {
    if (isUnseen(scene, instance) != unseen) continue;
    const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
    const glm::dmat3 linear(instance.world);
    const glm::dvec3 offset = linear * mesh.origin + glm::dvec3(instance.world[3]);
    inStretches(mesh.indices.size(), [&](std::size_t begin, std::size_t end) {
      Sum part = none;
      for (std::size_t i = begin; i < end; ++i)
        part.add(linear * glm::dvec3(mesh.positions[mesh.indices[i]]) + offset);
      const std::lock_guard lock(joining);
      sum.add(part);
    });
  }
  return sum;
}

glm::dvec3 unitOr(glm::dvec3 v, glm::dvec3 otherwise) {
  const double size = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (!(size > 0) || !std::isfinite(size)) return otherwise;
  v /= size;
  return v / std::sqrt(glm::dot(v, v));
}

// Orthonormal axes for looking along `view` with `up` pointing up.
glm::dmat3 axesFor(glm::dvec3 view, glm::dvec3 up) {
  const glm::dvec3 back = -view;
  up = unitOr(up, {0, 1, 0});
  glm::dvec3 right = glm::cross(up, back);
  if (glm::dot(right, right) < 1e-24)  // parallel to up: -Z replaces up, or +X
    right = glm::cross(std::abs(back.z) < 0.9 ? glm::dvec3(0, 0, -1) : glm::dvec3(1, 0, 0), back);
  right = unitOr(right, {1, 0, 0});
  return {right, glm::cross(back, right), back};
}

glm::dvec3 rotate(const glm::dvec3& v, const glm::dvec3& axis, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return v * c + glm::cross(axis, v) * s + axis * (glm::dot(axis, v) * (1 - c));
}

// Position and target of the camera, before azimuth and elevation.
struct View {
  glm::dvec3 position, focalPoint, up;
  double angle;  // radians, vertical
  bool orthographic;
  double orthographicHalfHeight;  // from a file's camera, or 0
  double near = 0, far = 0;       // from a file's camera, or 0
};

// Half of the largest angle at which a sphere around the focal point fits into the picture.
double smallerHalf(const Look& look, double angle, double aspect) {
  if (!look.cameraIntrinsics)
    return aspect >= 1 ? angle / 2 : std::atan(std::tan(angle / 2) * aspect);
  const glm::dvec4& lens = *look.cameraIntrinsics;
  const glm::dvec2 size(look.resolution), focal(lens.x, lens.y), point(lens.z, lens.w);
  const glm::dvec2 sides = glm::min(point, size - point) / focal, halves = size / 2.0 / focal;
  // If the principal point is outside the picture, use its middle.
  const double inside = std::min(sides.x, sides.y);
  return std::atan(inside > 0 ? inside : std::min(halves.x, halves.y));
}

// The camera with this index. Throws InputError if the file has none that can be shown.
const FileCamera& fileCamera(const Scene& scene, std::size_t index) {
  const auto& cameras = scene.cameras;
  const bool known = index < cameras.size();
  if (known && cameras[index].unusable.empty()) return cameras[index];
  std::string what = scene.name + " has ";
  if (known) {
    const std::string& name = cameras[index].name;
    what = scene.name + ": cameras[" + std::to_string(index) + "] " +
           (name.empty() ? "" : '"' + printable(name, 60) + "\" ") + cameras[index].unusable;
  } else {
    what += cameras.empty() ? "no camera" : std::to_string(cameras.size()) + " cameras";
  }
  constexpr std::size_t most = 20;
  const std::vector<int> usable = usableCameras(scene);
  std::string advice = "leave the option out";
  if (!usable.empty() && usable.size() == cameras.size()) {
    advice = "give 0 to " + std::to_string(cameras.size() - 1);
  } else if (!usable.empty()) {
    advice = "give " + std::to_string(usable[0]);
    for (std::size_t i = 1; i < std::min(usable.size(), most); ++i)
      advice += (i + 1 == usable.size() ? " or " : ", ") + std::to_string(usable[i]);
    if (usable.size() > most)
      advice += " or one of " + std::to_string(usable.size() - most) + " more";
  }
  throw InputError("--camera-index " + std::to_string(index) + ": " + what + ": " + advice);
}

View viewFor(const Scene& scene, const Look& look, const Bounds& bounds, double aspect) {
  View view{{}, bounds.center, {0, 1, 0}, 30 * radians, look.cameraOrthographic, 0};
  const double radius = bounds.radius > 0 ? bounds.radius : 1;
  glm::dvec3 direction{-std::sin(30 * radians) * std::cos(20 * radians), -std::sin(20 * radians),
                       -std::cos(30 * radians) * std::cos(20 * radians)};
  bool placed = false;
  if (look.cameraIndex) {
    const FileCamera& camera = fileCamera(scene, std::size_t(*look.cameraIndex));
    view.position = glm::dvec3(camera.world[3]);
    direction = unitOr(-glm::dvec3(camera.world[2]), {0, 0, -1});
    view.up = unitOr(glm::dvec3(camera.world[1]), {0, 1, 0});
    // Azimuth and elevation turn about the point on the view axis nearest to the model's centre.
    const double ahead = glm::dot(bounds.center - view.position, direction);
    view.focalPoint = view.position + direction * (ahead > radius * 1e-3 ? ahead : radius);
    view.orthographic = camera.orthographic || look.cameraOrthographic;
    // The camera's whole frame is shown: a narrower picture shows more above and below it.
    const double taller = camera.aspect > aspect ? camera.aspect / aspect : 1;
    view.orthographicHalfHeight = camera.orthographic ? camera.halfHeight * taller : 0;
    if (!camera.orthographic) view.angle = 2 * std::atan(std::tan(camera.viewAngle / 2) * taller);
    view.near = camera.near;
    view.far = camera.far;
    placed = true;
  }
  if (look.cameraViewUp) view.up = *look.cameraViewUp;
  if (look.cameraViewAngle) {
    view.angle = *look.cameraViewAngle * radians;
    view.orthographicHalfHeight = 0;
  }
  if (look.cameraDirection) direction = unitOr(*look.cameraDirection, direction);
  if (look.cameraFocalPoint) view.focalPoint = *look.cameraFocalPoint;
  if (look.cameraPosition) {
    view.position = *look.cameraPosition;
    if (look.cameraDirection && !look.cameraFocalPoint) {
      const double distance = glm::length(bounds.center - view.position);
      view.focalPoint = view.position + direction * (distance > 0 ? distance : radius);
    }
    placed = true;
  }
  if (!placed) {
    const double smaller = smallerHalf(look, view.angle, aspect);
    view.position =
        view.focalPoint - direction * (radius / (look.cameraZoomFactor * std::sin(smaller)));
  }
  return view;
}

}  // namespace

Bounds boundsOf(const Scene& scene) {
  Box box = overVertices(scene, false, Box());
  // A model that is invisible is framed all the same.
  const bool unseen = box.isEmpty();
  if (unseen) box = overVertices(scene, true, Box());
  if (box.isEmpty()) return {};
  const glm::dvec3 size = box.high - box.low;
  Bounds bounds{box.low + size * 0.5, 0};
  const double scale = std::max({size.x, size.y, size.z});
  if (!(scale > 0)) return bounds;
  const Farthest farthest = overVertices(scene, unseen, Farthest{bounds.center, scale});
  bounds.radius = scale * std::sqrt(farthest.square);
  return bounds;
}

std::vector<int> usableCameras(const Scene& scene) {
  std::vector<int> usable;
  for (std::size_t i = 0; i < scene.cameras.size(); ++i)
    if (scene.cameras[i].unusable.empty()) usable.push_back(int(i));
  return usable;
}

double distanceAhead(const Camera& camera, const Bounds& bounds) {
  const double radius = bounds.radius > 0 ? bounds.radius : 1;
  const double ahead = glm::dot(camera.eye - bounds.center, camera.axes[2]);
  return ahead > radius * 1e-3 ? ahead : radius;
}

double viewAngleOf(double halfHeight) {
  return std::clamp(2 * std::atan(halfHeight) / radians, smallestViewAngle, largestViewAngle);
}

Camera cameraFor(const Scene& scene, const Bounds& bounds, const Look& look) {
  Camera camera;
  camera.aspect = double(look.resolution.x) / look.resolution.y;
  View view = viewFor(scene, look, bounds, camera.aspect);

  glm::dvec3 away = view.position - view.focalPoint;
  double distance = glm::length(away);
  if (!(distance > 0) || !std::isfinite(distance)) {  // eye at the focal point
    distance = bounds.radius > 0 ? bounds.radius : 1;
    away = glm::dvec3(0, 0, distance);
  }
  away /= distance;
  glm::dmat3 axes = axesFor(-away, view.up);
  if (look.cameraAzimuthAngle != 0 || look.cameraElevationAngle != 0) {
    const glm::dvec3 up = unitOr(view.up, {0, 1, 0});
    const double azimuth = look.cameraAzimuthAngle * radians;
    away = rotate(away, up, azimuth);
    const glm::dvec3 right = rotate(axes[0], up, azimuth);
    const double elevation = -look.cameraElevationAngle * radians;
    away = rotate(away, right, elevation);
    axes = axesFor(-away, rotate(rotate(axes[1], up, azimuth), right, elevation));
    view.position = view.focalPoint + away * distance;
  }
  camera.eye = view.position;
  camera.axes = axes;
  camera.orthographic = view.orthographic;
  camera.halfHeight = std::tan(view.angle / 2);
  if (camera.orthographic)
    camera.halfHeight = view.orthographicHalfHeight > 0 ? view.orthographicHalfHeight
                                                        : camera.halfHeight * distance;
  if (look.cameraIntrinsics) {
    if (camera.orthographic)
      throw InputError(
          "--camera-intrinsics: not for a parallel projection: leave the option out, or " +
          std::string(look.cameraOrthographic ? "--camera-orthographic" : "--camera-index"));
    const glm::dvec4& lens = *look.cameraIntrinsics;
    const glm::dvec2 size(look.resolution);
    camera.halfHeight = size.y / (2 * lens.y);
    camera.aspect = size.x / lens.x / (size.y / lens.y);
    camera.shift = {1 - 2 * lens.z / size.x, 2 * lens.w / size.y - 1};
  }

  const double center = glm::dot(camera.eye - bounds.center, camera.axes[2]);
  const double reach = std::max(glm::length(camera.eye - bounds.center), bounds.radius);
  camera.unit = reach > 0 ? std::exp2(std::round(std::log2(reach))) : 1;
  if (look.clippingRange) {
    camera.near = look.clippingRange->x;
    camera.far = look.clippingRange->y;
  } else {
    const double margin = bounds.radius * 1e-3 + reach * 1e-6;
    camera.far = center + bounds.radius + margin;
    if (!(camera.far > 0)) camera.far = reach > 0 ? reach : 1;  // nothing is in front of the eye
    // With the eye inside the sphere, things as near as 1e-5 of the far distance are visible.
    camera.near = std::max(center - bounds.radius - margin, camera.far * 1e-5);
    camera.near = std::min(camera.near, camera.far * 0.999);
    camera.near = std::max(camera.near, view.near);
    if (view.far > 0) camera.far = std::min(camera.far, view.far);
    if (!(camera.far > camera.near)) camera.far = camera.near * 1.001;  // nothing lies between
  }
  return camera;
}

namespace {

// The look with its camera as position, focal point and up vector, turned about +Y through the
// centre.
Look definite(Look look, const Scene& scene, const Camera& camera, const Bounds& bounds,
              double degrees) {
  const double angle = degrees * radians, c = std::cos(angle), s = std::sin(angle);
  const auto turn = [&](const glm::dvec3& v) {
    return glm::dvec3(c * v.x + s * v.z, v.y, c * v.z - s * v.x);
  };
  double distance = distanceAhead(camera, bounds);
  // A parallel projection's half height is given as an angle at this distance: from about 1e-8 to
  // 90 degrees.
  if (camera.orthographic)
    distance = std::clamp(distance, camera.halfHeight, camera.halfHeight * 1e10);
  const glm::dvec3 eye = bounds.center + turn(camera.eye - bounds.center);
  look.cameraPosition = eye;
  look.cameraFocalPoint = eye - turn(camera.axes[2]) * distance;
  look.cameraViewUp = turn(camera.axes[1]);
  look.cameraDirection.reset();
  if (look.cameraIndex && !look.clippingRange) {
    const FileCamera& of = scene.cameras[std::size_t(*look.cameraIndex)];
    if (of.near > 0 || of.far > 0)
      // camera.far is the larger one if the file's camera ends in front of the model.
      look.clippingRange = {of.near > 0 ? of.near : camera.near, std::max(of.far, camera.far)};
  }
  look.cameraIndex.reset();
  look.cameraAzimuthAngle = look.cameraElevationAngle = 0;
  look.cameraOrthographic = camera.orthographic;
  const double half = camera.orthographic ? camera.halfHeight / distance : camera.halfHeight;
  if (!look.cameraIntrinsics) look.cameraViewAngle = viewAngleOf(half);
  return look;
}

}  // namespace

Look turnedLook(const Look& base, const Scene& scene, const Bounds& bounds, double degrees) {
  Look look = base;
  const bool aboutCenter = !look.cameraViewUp && !look.cameraFocalPoint && !look.cameraIndex &&
                           !(look.cameraPosition && look.cameraDirection);
  if (aboutCenter) {  // then adding to the azimuth does the same, and suits other models too
    look.cameraAzimuthAngle += degrees;
    return look;
  }
  return definite(look, scene, cameraFor(scene, bounds, base), bounds, degrees);
}

Look definiteLook(const Look& look, const Scene& scene, const Bounds& bounds) {
  return definite(look, scene, cameraFor(scene, bounds, look), bounds, 0);
}

Bounds around(const Bounds& a, const Bounds& b) {
  const glm::dvec3 way = b.center - a.center;
  const double distance = std::sqrt(glm::dot(way, way));
  if (distance + b.radius <= a.radius) return a;
  if (distance + a.radius <= b.radius) return b;
  const double radius = (distance + a.radius + b.radius) / 2;
  return {a.center + way * ((radius - a.radius) / distance), radius};
}

glm::dmat3 eyeRotation(const Camera& camera) {
  return glm::transpose(camera.axes) * (1 / camera.unit);
}

glm::dmat4 projection(const Camera& camera, glm::dvec2 lower, glm::dvec2 upper, bool reversed) {
  const double near = camera.near / camera.unit, far = camera.far / camera.unit;
  const double height = camera.orthographic ? camera.halfHeight / camera.unit : camera.halfHeight;
  glm::dmat4 m(0.0);
  m[0][0] = 1 / (height * camera.aspect);
  m[1][1] = 1 / height;
  if (camera.orthographic) {
    m[2][2] = reversed ? 1 / (far - near) : -2 / (far - near);
    m[3][2] = reversed ? far / (far - near) : -(far + near) / (far - near);
    m[3][3] = 1;
  } else {
    m[2][2] = reversed ? near / (far - near) : -(far + near) / (far - near);
    m[3][2] = reversed ? far * near / (far - near) : -2 * far * near / (far - near);
    m[2][3] = -1;
    m[2][0] = camera.shift.x;
    m[2][1] = camera.shift.y;
  }
  // Maps the part of the picture to the whole of clip space.
  const glm::dvec2 scale = 1.0 / (upper - lower), offset = (1.0 - lower - upper) * scale;
  glm::dmat4 part(1.0);
  part[0][0] = scale.x;
  part[1][1] = scale.y;
  part[3][0] = offset.x;
  part[3][1] = offset.y;
  return part * m;
}

}  // namespace glint
