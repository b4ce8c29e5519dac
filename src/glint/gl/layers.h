#pragma once

#include "glint/gl/framebuffer.h"

namespace glint {

/// Whether the driver can shade individual samples (GL_ARB_sample_shading), without which the
/// layers of a multisampled picture cannot be separated.
bool canLayerSamples();

/// Depth buffers for peeling blended surfaces from back to front, layer by layer (Everitt 2001), at
/// every sample of a picture's target. There are two: one receives the current layer's depths while
/// the other, with those of the layer before, is read.
class DepthLayers {
 public:
  /// Same size and samples as the target. Throws Error if the driver cannot create them.
  explicit DepthLayers(const RenderTarget& target);

  /// Binds the depth buffer of layer `number` (from 0, the farthest) for drawing, and the depths of
  /// the layer before, or the target's own for layer 0, to a texture unit.
  void bindDepths(int number, GLuint unit) const;

  /// Binds the target's colours for drawing, with the depths of this layer.
  void bindColors(int number) const;

 private:
  const RenderTarget& target_;
  TextureHandle depths_[2];
  Framebuffer depthAlone_[2], withColor_[2];  // after the textures, so destroyed before them
};

}  // namespace glint
