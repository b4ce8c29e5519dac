#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "glint/scene/camera.h"
#include "glint/scene/look.h"
#include "glint/scene/scene.h"

namespace glint::viewer {

/// A camera as a hand moves it: where it is, what it looks at, which way is up (world space).
struct Pose {
  glm::dvec3 position{0, 0, 1}, focalPoint{0.0}, up{0, 1, 0};
  double viewAngle = 30.0;  ///< degrees, vertical
  bool orthographic = false;
};

/// The pose of the camera that a look gives a scene.
Pose poseOf(const Scene&, const Bounds&, const Look&);

/// Puts a pose into a look, in place of everything else that it says about the camera.
void setPose(Look&, const Pose&);

/// Turns about the focal point, or about `pivot`, which then stays where it is in the picture: to
/// the right about `up`, then upwards; degrees. Stops half a degree short of looking along `up`.
Pose orbited(const Pose&, double right, double upwards, std::optional<glm::dvec3> pivot = {});

/// Moves the camera with what it looks at, so that the focal plane follows a hand that moves by
/// (right, down) as shares of the picture's height.
Pose panned(const Pose&, double right, double down);

/// The point of the focal plane under a cursor; the cursor is in units of half the picture's height
/// from its centre, x to the right, y upwards.
glm::dvec3 focalPlanePoint(const Pose&, glm::dvec2 cursor);

/// Changes the distance to a point by a factor above 0. The point stays where it is in the picture
/// and is never passed.
Pose dollied(const Pose&, double factor, const glm::dvec3& point);

/// Turns the camera about the way it looks; degrees, counter-clockwise as the picture is seen.
Pose rolled(const Pose&, double angle);

enum class StandardView { front, back, right, left, top, bottom, isometric };

/// Shows the whole scene from one side.
void setView(Look&, StandardView);

/// Shows the whole scene from where the camera is.
void fit(Look&, const Scene&, const Bounds&);

/// The framing that a scene has without camera options.
void resetCamera(Look&);

/// A half-line in world space; the direction is unit. Around it stands a pixel: at the distance t,
/// its width is width + spread t.
struct Ray {
  glm::dvec3 origin{0.0}, direction{0, 0, -1};
  double width = 0, spread = 0;
};

/// The ray through a point of the picture, in pixels from the upper left corner (pixel centres at
/// .5), for a camera made with look.resolution.
Ray rayThrough(const Camera&, glm::dvec2 pixel, glm::ivec2 resolution);

}  // namespace glint::viewer
