#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "glint/gl/handles.h"
#include "glint/gl/program.h"

namespace glint {

/// The most samples per pixel that the driver supports for float colour and float depth; 1 without
/// multisampling. This is tested, because drivers announce counts whose framebuffers are
/// incomplete. llvmpipe only has 4 (2 and 3 give 4).
int maxSamples();

/// Throws Error if the bound framebuffer cannot be drawn to.
void checkFramebuffer();

/// A picture in the driver's memory: RGBA32F colour and DEPTH_COMPONENT32F. With more than one
/// sample both are multisampled, and there is a single-sample colour buffer as well.
class RenderTarget {
 public:
  /// Width and height in pixels. `samples` per pixel is a request; the driver may give more
  /// (samples()). Throws InputError, with what to use instead, if the driver does not support the
  /// size or that many samples; Error if it cannot create the target. Leaves the target bound.
  RenderTarget(int width, int height, int samples);

  int width() const { return width_; }
  int height() const { return height_; }
  /// The samples per pixel that the driver gave; 1 without multisampling.
  int samples() const { return samples_; }

  /// The positions of the samples in a pixel, from its lower left corner, 0 to 1; empty without
  /// multisampling. Binds this target.
  std::vector<glm::vec2> samplePositions() const;

  /// Binds the target for drawing and sets the viewport to all of it.
  void bind() const;

  /// Averages the samples of each pixel, in linear light, with its own program: the sum is then the
  /// same on every driver, and the program is compiled only once (a software driver recompiles the
  /// one behind glBlitFramebuffer in every process, 100 ms). Call it after drawing and before
  /// read() or blitting; it is a no-op with one sample. It leaves other framebuffers bound and GL
  /// state changed: call bind() and set the state before drawing more.
  void resolve() const;

  /// Copies the width x height pixels in the lower left corner to rgba: four floats per pixel,
  /// linear, as drawn; top row first, as in a picture file, rows `stride` pixels apart. Waits until
  /// drawing is done. Leaves the resolved picture bound for reading.
  void read(float* rgba, int width, int height, int stride) const;

  /// The depth of each sample, as a texture that may be read while nothing draws to it; and a
  /// further texture of the same kind (for DepthLayers).
  const TextureHandle& depths() const { return depth_; }
  TextureHandle makeDepths() const;
  /// Attach such a depth texture, or the colours, to the bound framebuffer.
  void attachDepths(const TextureHandle& depths) const;
  void attachColors() const;
  GLenum textureTarget() const { return samples_ > 1 ? GL_TEXTURE_2D_MULTISAMPLE : GL_TEXTURE_2D; }

  /// The framebuffer with the resolved picture, as a source for blitting.
  GLuint resolved() const { return samples_ > 1 ? single_.id() : drawn_.id(); }

 private:
  int width_, height_, samples_ = 1;
  Renderbuffer color_;
  TextureHandle samplesColor_;  // instead of color_ if multisampled
  TextureHandle depth_;
  Program resolve_;
  VertexArray noVertices_;
  Framebuffer drawn_, single_;  // after the renderbuffers, so destroyed before them
};

}  // namespace glint
