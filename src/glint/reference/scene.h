#pragma once

#include <optional>
#include <span>
#include <vector>

#include "glint/reference/shade.h"
#include "glint/reference/texture.h"
#include "glint/render/decode.h"
#include "glint/render/draw_list.h"

namespace glint::reference {

/// The vertices of an instance. Window space is in samples of the picture, y upwards from the lower
/// edge, homogeneous: the vertex is at (x / w, y / w).
struct Vertices {
  std::vector<glm::dvec3> window;  ///< x, y, w
  std::vector<double> depth;       ///< z of clip space: depth times w
  std::vector<glm::dvec3> eye;
  std::vector<glm::dvec3> normals;  ///< unit, eye space; empty unless triangles
  /// Unit, eye space, and handedness; empty unless the mesh has them.
  std::vector<glm::dvec4> tangents;
  glm::dmat3 eyeFromModel{1.0};  ///< without translation
};

/// A texture and the coordinates at which its mesh reads it.
struct Looked {
  TextureSampler sampler;
  std::vector<glm::dvec2> texcoords;
};

/// An item of the draw list with everything that the reference reads of it.
struct Item {
  const Mesh* mesh = nullptr;
  std::size_t vertices = 0;  ///< index into Stage::vertices
  Surface surface;
  glm::dvec4 color{1.0};  ///< C and alpha of the material
  glm::dvec3 emission{0.0};
  bool mask = false, blended = false, mirrored = false;
  double alphaCutoff = 0;
  FaceSide faces = FaceSide::both;
  double thickness = 1;       ///< of lines and points, in samples of the grid
  bool multisampled = false;  ///< lines are rectangles (Primitive)
  std::optional<TextureSampler> colorTexture, emissionTexture, normalTexture;
  std::vector<glm::dvec2> colorTexcoords, emissionTexcoords, normalTexcoords;  ///< of these
  double normalScale = 1;
  unsigned textured = 0;  ///< bits of namespace textured that the following give
  ParameterTextures parameters;
  std::optional<Looked> metallicRoughness, occlusion, specular, transmission;
};

/// A scene as the camera sees it, in double throughout. From the draw list it takes the order, the
/// camera, which faces show and which textures are read. Scene and images must outlive it.
struct Stage {
  Stage(const Scene& scene, const DecodedImages& images, const DrawList& list, const Look& look);

  glm::ivec2 grid{0};               ///< samples across and down; pixels if multisampled
  std::vector<glm::dvec2> samples;  ///< multisampled: where in a pixel they lie (samples.h)
  Frame frame;
  std::vector<Vertices> vertices;
  std::vector<Item> items;
  Camera camera;

  /// The direction of the ray through a place of the grid, eye space; not unit.
  glm::dvec3 ray(double x, double y) const;
};

}  // namespace glint::reference
