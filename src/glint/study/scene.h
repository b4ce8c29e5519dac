#pragma once

#include <optional>
#include <string>

#include "glint/render/renderer.h"
#include "glint/scene/camera.h"

namespace glint {

/// A scene made ready to be drawn by GL and by the reference. The scene must not move.
struct StudyScene {
  Scene scene;
  Bounds bounds;
  DecodedImages images;

  /// Decodes the images that any program reads.
  StudyScene(Scene scene, const Look& look);
  /// With its images decoded.
  StudyScene(Scene scene, DecodedImages images);
  StudyScene(const StudyScene&) = delete;
  StudyScene& operator=(const StudyScene&) = delete;
};

/// The icosahedron cut into four `level` times, on the unit sphere: 20 * 4^level triangles; one
/// material with the given values.
Scene sphereScene(int level, const ShadingParameters& shading);

/// Of the built-in sphere: red plastic.
ShadingParameters sphereMaterial();

}  // namespace glint
