#pragma once

#include <memory>
#include <vector>

#include "glint/render/blocks.h"
#include "glint/render/environment_image.h"
#include "glint/render/variant.h"
#include "glint/scene/camera.h"

namespace glint {

enum class FaceSide { front, both };

/// One draw call to be.
struct DrawItem {
  int mesh = 0, material = 0, instance = 0;  ///< indices into the scene's
  Variant variant;
  DrawBlock draw;
  MaterialBlock materialBlock;
  std::vector<glm::vec4> lobeTables;  ///< lobeTableRows() of the variant: the exponent's lobe
  bool mirrored = false;              ///< the transform turns counter-clockwise into clockwise
  FaceSide faces = FaceSide::front;
  bool blended = false;       ///< drawn after the others, layer by layer, without writing depth
  double depth = 0.0;         ///< of the centre of its bounding box along the view; eye space units
  glm::vec3 low{0}, high{0};  ///< of what is blended: that box, model space
};

/// All that a picture takes, decided without GL.
struct DrawList {
  Camera camera;
  FrameBlock frame;  ///< but for projection and rays, which depend on the tile
  /// In the order of blocks.glsl. `constant` holds L + V; with Blinn-Phong, H.
  std::vector<LightEntry> lights;
  std::vector<int> lightNumbers;  ///< of each of them: its place in lightsOf() the look
  std::vector<DrawItem> items;    ///< in drawing order
  /// Where the look's environment is a picture and something shows it.
  std::shared_ptr<const EnvironmentImage> environment;
};

/// What one call of GL draws: items of a list in a row that differ in their places alone.
struct DrawCall {
  std::size_t first = 0, count = 1;
};

/// The most places that one call draws: as many as the least uniform block of GL holds.
inline constexpr std::size_t mostInstances = 128;
static_assert(mostInstances * sizeof(DrawBlock) <= 16384);

/// The calls that draw a list, in its order. What is blended is drawn piece by piece.
std::vector<DrawCall> drawCalls(const std::vector<DrawItem>& items);

/// `bounds` are those of the scene. Throws InputError for a camera or a material that the scene
/// does not have.
DrawList makeDrawList(const Scene&, const Bounds& bounds, const Look&);

/// Images (indices into Scene::images) that the variants of this look read: the only ones that
/// need decoding. In ascending order.
std::vector<int> imagesRead(const Scene&, const Look&);

}  // namespace glint
