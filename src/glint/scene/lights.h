#pragma once

#include <cstddef>
#include <vector>

#include "glint/scene/look.h"
#include "glint/scene/scene.h"

namespace glint {

/// How much light a file's lights give.
struct LightMeter {
  /// Multiplying the lights by this gives 95 % of the surface that they reach, by area, at most 1
  /// of I N.L in any channel: white matte paint then stays within the picture's range.
  double scale = 1;
  std::vector<double> shares;  ///< light from each: its mean over the surface, in the file's units
};

/// Measures at up to about 65,000 points, spread evenly over the triangles, without shadows.
/// `Scene::lightScale` is ignored. If the lights reach nothing, the scale is 1.
LightMeter meterLights(const Scene&);

/// The look with the file's lights in `light` if they apply: the look sets neither `light` nor
/// `noLights`, and the file has some. Their intensities are multiplied by the look's light scale
/// or, if it has none, by the scene's.
Look withFileLights(const Scene&, const Look&);

}  // namespace glint
