#pragma once

#include <memory>
#include <vector>

#include "glint/render/blocks.h"
#include "glint/render/environment_image.h"
#include "glint/render/variant.h"
#include "glint/scene/camera.h"

namespace glint {

enum class FaceSide { front, both };

/// An instance of a mesh to draw.
struct DrawItem {
  int mesh = 0, material = 0, instance = 0;  ///< indices into the scene's vectors
  Variant variant;
  DrawBlock draw;
  MaterialBlock materialBlock;
  std::vector<glm::vec4> lobeTables;  ///< lobeTableRows(variant) rows: the lobe at this exponent
  bool mirrored = false;              ///< the transform turns counter-clockwise into clockwise
  FaceSide faces = FaceSide::front;
  bool blended = false;       ///< drawn after the others, layer by layer, without writing depth
  double depth = 0.0;         ///< blended: of its bounding box's centre along the view, eye space
  glm::vec3 low{0}, high{0};  ///< blended: that box, model space
};

/// Everything needed to draw a picture, decided without GL.
struct DrawList {
  Camera camera;
  FrameBlock frame;  ///< except projection and rays, which depend on the tile
  /// In the order of blocks.glsl. `halfway` of directional lights holds L + V; with Blinn-Phong, H.
  std::vector<LightEntry> lights;
  std::vector<int> lightNumbers;  ///< for each of them, its index in lightsOf(look)
  std::vector<DrawItem> items;    ///< in drawing order
  /// Null unless the look's environment is a picture and something shows it.
  std::shared_ptr<const EnvironmentImage> environment;
};

/// What one GL call draws: consecutive items of a list that differ only in where they are.
struct DrawCall {
  std::size_t first = 0, count = 1;
};

/// The most instances that one call draws: as many as fit into the smallest uniform block that GL
/// allows a driver.
inline constexpr std::size_t mostInstances = 128;
static_assert(mostInstances * sizeof(DrawBlock) <= 16384);

/// The calls that draw a list, in its order. Each blended item gets a call of its own.
std::vector<DrawCall> drawCalls(const std::vector<DrawItem>& items);

/// `bounds` are those of the scene. Throws InputError for a camera or a material that the scene
/// does not have.
DrawList makeDrawList(const Scene&, const Bounds& bounds, const Look&);

/// Images (indices into Scene::images) that the variants of this look read: the only ones that
/// need decoding. In ascending order.
std::vector<int> imagesRead(const Scene&, const Look&);

}  // namespace glint
