#pragma once

#include <cstddef>
#include <vector>

#include "glint/scene/look.h"
#include "glint/scene/scene.h"

namespace glint {

/// How much light a file's lights bring.
struct LightMeter {
  /// What they are to be multiplied by so that 95 % of the surface that they reach, by area, gets
  /// no more than 1 of I N.L in any channel: white matte paint then stays within the picture.
  double scale = 1;
  std::vector<double> shares;  ///< what each brings, mean over the surface, in the file's units
};

/// Measures at up to about 65,000 points, spread over the triangles evenly, without shadows.
/// `Scene::lightScale` is not read. Lights that reach nothing give the scale 1.
LightMeter meterLights(const Scene&);

/// The look with the file's lights in `light` where they count: neither `light` nor `noLights` says
/// otherwise, and the file has some. Their intensities are multiplied by the look's light scale or
/// else by the scene's.
Look withFileLights(const Scene&, const Look&);

}  // namespace glint
