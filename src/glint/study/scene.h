#pragma once

#include <optional>
#include <string>

#include "glint/render/renderer.h"
#include "glint/scene/camera.h"

namespace glint {

/// A scene ready to be drawn by GL and by the reference. The scene must not move.
struct StudyScene {
  Scene scene;
  Bounds bounds;
  DecodedImages images;

  /// Decodes the images that any program reads.
  StudyScene(Scene scene, const Look& look);
  /// With images that are decoded already.
  StudyScene(Scene scene, DecodedImages images);
  StudyScene(const StudyScene&) = delete;
  StudyScene& operator=(const StudyScene&) = delete;
};

/// One mesh with one material.
Scene sceneOf(const char* name, Mesh mesh, const Material& material);

/// An icosahedron whose triangles are divided into four `level` times, on the unit sphere: 20 *
/// 4^level triangles. One material with the given values.
Scene sphereScene(int level, const ShadingParameters& shading);

/// A sphere of longitudes and latitudes with a normal map of small random bumps, and its decoded
/// images, with the lengths of normals.
Scene bumpySphereScene(const ShadingParameters& shading);
DecodedImages bumpyImages();

/// Lights within `degrees` of +Z, spread evenly (on a golden spiral), together as bright as one.
std::vector<Light> spreadLights(int count, double degrees, Light::Type type);

/// The material of the built-in sphere: red plastic.
ShadingParameters sphereMaterial();

}  // namespace glint
