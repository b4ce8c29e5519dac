#pragma once

#include "glint/gl/framebuffer.h"

namespace glint {

/// Whether the driver shades single samples (GL_ARB_sample_shading), without which the layers of a
/// multisampled picture cannot be told apart.
bool canLayerSamples();

/// The depths by which blended surfaces are peeled off from the back, layer by layer (Everitt
/// 2001), at every sample of a picture's target: two depth buffers, of which one takes the layer's
/// while the other, that of the layer before, is read.
class DepthLayers {
 public:
  /// As large as the target and with its samples. Throws Error if the driver cannot make it.
  explicit DepthLayers(const RenderTarget& target);

  /// Makes the depths of layer `number` (from 0, the farthest) what is drawn into, and binds those
  /// of the layer before, or the target's own, to a texture unit.
  void bindDepths(int number, GLuint unit) const;

  /// Makes the target's colours what is drawn into, with the depths of this layer.
  void bindColors(int number) const;

 private:
  const RenderTarget& target_;
  TextureHandle depths_[2];
  Framebuffer depthAlone_[2], withColor_[2];  // after the textures: deleted before them
};

}  // namespace glint
