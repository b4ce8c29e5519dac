#pragma once

#include "glint/gl/handles.h"
#include "glint/gl/program.h"
#include "glint/render/draw_list.h"
#include "glint/render/gpu_scene.h"
#include "session.h"

namespace glint {

/// Edges, normals and facing, drawn over the picture in the window; the picture itself stays as it
/// is.
class OverlayDrawer {
 public:
  OverlayDrawer();

  /// Draws what `list` drew, as `overlay` asks, into a buffer of its own.
  void draw(GpuScene&, const DrawList& list, Overlay overlay, glm::ivec2 size);

  /// Lays it over the window's framebuffer at (x, y) from its upper left corner.
  void show(int x, int y, int framebufferHeight) const;

 private:
  void resize(glm::ivec2 size);

  Program surface_, lay_;
  Buffer block_;
  TextureHandle color_;
  Renderbuffer depth_;
  Framebuffer framebuffer_;
  VertexArray noVertices_;
  glm::ivec2 size_{0};
};

}  // namespace glint
