#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "glint/gl/handles.h"
#include "glint/gl/program.h"

namespace glint {

/// The most samples a pixel that the driver gives a picture with float colour and float depth: 1
/// if it has no multisampling. It is tried, not believed: drivers announce counts whose
/// framebuffers are incomplete. llvmpipe has 4 and no other (2 and 3 give 4).
int maxSamples();

/// Throws Error if what is bound cannot be drawn into.
void checkFramebuffer();

/// A picture in the driver's memory: RGBA32F colour and DEPTH_COMPONENT32F, with more than one
/// sample multisampled and beside it the colour with one sample.
class RenderTarget {
 public:
  /// Width and height in pixels, samples a pixel as asked for; the driver may give more
  /// (samples()). Throws InputError if the driver has no such size or not as many samples, with
  /// what to use instead; Error if it cannot make it. Leaves the target bound.
  RenderTarget(int width, int height, int samples);

  int width() const { return width_; }
  int height() const { return height_; }
  /// The samples a pixel that the driver gave, 1 without multisampling.
  int samples() const { return samples_; }

  /// Where in a pixel the samples lie, from its lower left corner, 0 to 1; none without
  /// multisampling. Binds this target.
  std::vector<glm::vec2> samplePositions() const;

  /// Makes it what is drawn into and sets the viewport to the whole of it.
  void bind() const;

  /// Averages the samples of each pixel, in linear light, by a program of its own: the sum is then
  /// the same on every driver, and it is compiled once for all (a software driver compiles the
  /// program of glBlitFramebuffer anew in every process, 100 ms). Call it after drawing and before
  /// read() or blitting; does nothing if there is one sample. Leaves other framebuffers bound and
  /// state changed: bind() and set state before drawing more.
  void resolve() const;

  /// Copies the rectangle of width x height pixels in the lower left corner to rgba: four floats a
  /// pixel, linear, as drawn; the top row first, as in a picture file, each `stride` pixels behind
  /// the one before. Waits until drawing is done. Leaves the resolved picture bound for reading.
  void read(float* rgba, int width, int height, int stride) const;

  /// The depths of each sample, as a texture to be read while nothing draws into them; and more of
  /// the same kind (DepthLayers).
  const TextureHandle& depths() const { return depth_; }
  TextureHandle makeDepths() const;
  /// Attach depths of that kind, or the colours, to the framebuffer that is bound.
  void attachDepths(const TextureHandle& depths) const;
  void attachColors() const;
  GLenum textureTarget() const { return samples_ > 1 ? GL_TEXTURE_2D_MULTISAMPLE : GL_TEXTURE_2D; }

  /// The framebuffer with the resolved picture, to be blitted from.
  GLuint resolved() const { return samples_ > 1 ? single_.id() : drawn_.id(); }

 private:
  int width_, height_, samples_ = 1;
  Renderbuffer color_;
  TextureHandle samplesColor_;  // in place of color_ where there are samples
  TextureHandle depth_;
  Program resolve_;
  VertexArray noVertices_;
  Framebuffer drawn_, single_;  // after the renderbuffers: deleted before them
};

}  // namespace glint
