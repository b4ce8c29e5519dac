#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "glint/scene/look.h"
#include "glint/scene/scene.h"

namespace glint {

/// The bounding sphere of what a scene draws, in world space.
struct Bounds {
  glm::dvec3 center{0.0};
  double radius = 0.0;  ///< 0 if there is nothing, or only a single point
};

/// Objects with scale 0 or alpha 0 do not count unless there is nothing else. The centre is that of
/// the axis-aligned box around all drawn vertices, the radius the distance to the farthest of them.
Bounds boundsOf(const Scene&);

/// A resolved camera: position, orientation and projection.
struct Camera {
  glm::dvec3 eye{0.0};
  glm::dmat3 axes{
      1.0};  ///< columns: right, up, back (towards the viewer); orthonormal, world space
  bool orthographic = false;
  double halfHeight =
      1.0;              ///< of the picture at distance 1 (perspective), or anywhere (orthographic)
  double aspect = 1.0;  ///< width / height of what is seen
  /// Offset of the picture's middle from the view axis, to the right and up, in half widths and
  /// half heights (perspective).
  glm::dvec2 shift{0.0};
  double near = 1.0, far = 2.0;  ///< along the view, world units; 0 < near < far
  /// The world units in one unit of eye space, a power of two near the distance of what is looked
  /// at: a scene scaled by any factor then gives the same floats.
  double unit = 1.0;
};

/// The indices of the file's cameras that can be shown.
std::vector<int> usableCameras(const Scene&);

/// The camera of a look at a scene. Throws InputError for a camera index that the file does not
/// have, and for a look with intrinsics whose camera is orthographic. Every other input gives a
/// finite camera: if the eye is at the focal point, or the view is along the up vector, another
/// axis replaces the undefined one.
Camera cameraFor(const Scene&, const Bounds&, const Look&);

/// How far ahead on the view axis the point is that stands for what the camera looks at: beside the
/// centre of the bounds or, if that is behind the camera or so near that the direction from the eye
/// to this point would be lost in rounding, at the distance of the radius.
double distanceAhead(const Camera&, const Bounds&);

/// The view angle in degrees of a perspective camera with this halfHeight, within the range that a
/// look can hold.
double viewAngleOf(double halfHeight);

/// The look with its camera turned to the right by `degrees` about +Y through the centre of the
/// bounds; it shows the model as if that had been turned to the left.
Look turnedLook(const Look&, const Scene&, const Bounds&, double degrees);

/// The look with its camera given by position, focal point, up vector and view angle, so that it
/// stays where it is when the model moves.
Look definiteLook(const Look&, const Scene&, const Bounds&);

/// A sphere that encloses both.
Bounds around(const Bounds&, const Bounds&);

/// The rotation from world space to eye space (units of camera.unit, looking along -Z).
glm::dmat3 eyeRotation(const Camera&);

/// From eye space to clip space for a part of the picture; its corners are fractions of width and
/// height from the lower left, [0, 1]. With `reversed`, depth is 1 at near, 0 at far, for clip
/// space z in [0, w]; otherwise GL's -1 to 1.
glm::dmat4 projection(const Camera&, glm::dvec2 lower, glm::dvec2 upper, bool reversed);

}  // namespace glint
