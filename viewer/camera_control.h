#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "glint/scene/camera.h"
#include "glint/scene/look.h"
#include "glint/scene/scene.h"

namespace glint::viewer {

/// A camera for interaction: where it is, what it looks at, which way is up (world space).
struct Pose {
  glm::dvec3 position{0, 0, 1}, focalPoint{0.0}, up{0, 1, 0};
  double viewAngle = 30.0;  ///< degrees, vertical
  bool orthographic = false;
};

/// The pose of the camera that a look specifies for a scene.
Pose poseOf(const Scene&, const Bounds&, const Look&);

/// Writes a pose into a look, replacing all its other camera options.
void setPose(Look&, const Pose&);

/// Orbits around the focal point, or around `pivot`, which then stays where it is in the picture:
/// first right, about `up`, then upwards; degrees. Stops half a degree short of looking along `up`.
Pose orbited(const Pose&, double right, double upwards, std::optional<glm::dvec3> pivot = {});

/// Moves the camera and its focal point so that the focal plane follows a drag by (right, down), in
/// fractions of the picture's height.
Pose panned(const Pose&, double right, double down);

/// The point of the focal plane under a cursor, which is given relative to the centre in units of
/// half the picture's height, x to the right, y upwards.
glm::dvec3 focalPlanePoint(const Pose&, glm::dvec2 cursor);

/// Scales the distance to a point by a factor above 0. The point stays where it is in the picture
/// and is never passed.
Pose dollied(const Pose&, double factor, const glm::dvec3& point);

/// Turns the camera about its viewing direction; degrees, counter-clockwise in the picture.
Pose rolled(const Pose&, double angle);

enum class StandardView { front, back, right, left, top, bottom, isometric };

/// Shows the whole scene from one side.
void setView(Look&, StandardView);

/// Shows the whole scene, keeping the viewing direction.
void fit(Look&, const Scene&, const Bounds&);

/// Restores the framing that a scene has without camera options.
void resetCamera(Look&);

/// A ray in world space with a unit direction. At the distance t, its pixel's footprint has the
/// width `width` + `spread` t.
struct Ray {
  glm::dvec3 origin{0.0}, direction{0, 0, -1};
  double width = 0, spread = 0;
};

/// The ray through a point of the picture, in pixels from the upper left corner (pixel centres at
/// .5), for a camera made with look.resolution.
Ray rayThrough(const Camera&, glm::dvec2 pixel, glm::ivec2 resolution);

}  // namespace glint::viewer
