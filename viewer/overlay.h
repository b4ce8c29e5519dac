#pragma once

#include <cstdint>
#include <vector>

#include "glint/gl/handles.h"
#include "glint/gl/program.h"
#include "glint/render/draw_list.h"
#include "glint/render/gpu_scene.h"
#include "session.h"

namespace glint::viewer {

/// Draws edges, normals, facing and outlines to lay over the picture in the window; the picture
/// itself is not changed.
class OverlayDrawer {
 public:
  OverlayDrawer();

  /// Draws the surfaces of `list` as `overlay` asks: RGBA with straight alpha, rows from the top.
  /// `outlined` is the material to outline, -1 for all.
  std::vector<std::uint8_t> draw(GpuScene&, const DrawList& list, Overlay overlay, int outlined,
                                 glm::ivec2 size);

 private:
  void resize(glm::ivec2 size);

  Program surface_;
  Buffer block_;
  TextureHandle color_;
  Renderbuffer depth_;
  Framebuffer framebuffer_;
  glm::ivec2 size_{0};
};

}  // namespace glint::viewer
