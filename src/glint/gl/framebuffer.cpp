#include "glint/gl/framebuffer.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "glint/gl/check.h"
#include "glint/image/error.h"

namespace glint {

namespace {

const char* statusWords(GLenum status) {
  switch (status) {
    case GL_FRAMEBUFFER_UNSUPPORTED:
      return "float colour and float depth are not supported";
    case GL_FRAMEBUFFER_INCOMPLETE_ATTACHMENT:
      return "an attachment could not be made";
    case GL_FRAMEBUFFER_INCOMPLETE_MISSING_ATTACHMENT:
      return "it has no attachment";
    case GL_FRAMEBUFFER_INCOMPLETE_MULTISAMPLE:
      return "this count of samples is not supported";
    default:
      return "no reason given";
  }
}

/// Storage for one buffer of a framebuffer; 0 samples means no multisampling. Returns the samples
/// granted.
int makeStorage(const Renderbuffer& buffer, GLenum format, int width, int height, int samples) {
  glBindRenderbuffer(GL_RENDERBUFFER, buffer.id());
  glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, format, width, height);
  GLint given = 0;
  glGetRenderbufferParameteriv(GL_RENDERBUFFER, GL_RENDERBUFFER_SAMPLES, &given);
  return given;
}

/// With samples, a multisampled texture; without, one whose texels are read unfiltered.
int makeStorage(const TextureHandle& texture, GLenum format, int width, int height, int samples) {
  if (samples == 0) {
    const bool depth = format == GL_DEPTH_COMPONENT32F;
    GLint before = 0;  // the caller's binding is restored
    glGetIntegerv(GL_TEXTURE_BINDING_2D, &before);
    glBindTexture(GL_TEXTURE_2D, texture.id());
    glTexImage2D(GL_TEXTURE_2D, 0, GLint(format), width, height, 0,
                 depth ? GL_DEPTH_COMPONENT : GL_RGBA, GL_FLOAT, nullptr);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glBindTexture(GL_TEXTURE_2D, GLuint(before));
    return 0;
  }
  glBindTexture(GL_TEXTURE_2D_MULTISAMPLE, texture.id());
  glTexImage2DMultisample(GL_TEXTURE_2D_MULTISAMPLE, samples, format, width, height, GL_TRUE);
  GLint given = 0;
  glGetTexLevelParameteriv(GL_TEXTURE_2D_MULTISAMPLE, 0, GL_TEXTURE_SAMPLES, &given);
  return given;
}

void attach(GLenum point, const TextureHandle& texture, GLenum target) {
  glFramebufferTexture2D(GL_FRAMEBUFFER, point, target, texture.id(), 0);
}

void attach(GLenum point, const Renderbuffer& buffer) {
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, point, GL_RENDERBUFFER, buffer.id());
}

/// The samples that the driver gives a tiny target, or 0 if it cannot create one.
int trySamples(int samples) {
  const TextureHandle color = TextureHandle::make();
  const TextureHandle depth = TextureHandle::make();
  const Framebuffer framebuffer = Framebuffer::make();
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
  const int given = makeStorage(color, GL_RGBA32F, 1, 1, samples);
  makeStorage(depth, GL_DEPTH_COMPONENT32F, 1, 1, samples);
  attach(GL_COLOR_ATTACHMENT0, color, GL_TEXTURE_2D_MULTISAMPLE);
  attach(GL_DEPTH_ATTACHMENT, depth, GL_TEXTURE_2D_MULTISAMPLE);
  const bool complete = glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
  const bool valid = glGetError() == GL_NO_ERROR;
  return complete && valid ? given : 0;
}

void checkSize(int width, int height) {
  GLint buffer = 0, viewport[2] = {0, 0};
  glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &buffer);
  glGetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport);
  const int most = std::min({buffer, viewport[0], viewport[1]});
  if (width < 1 || height < 1 || width > most || height > most)
    throw InputError("--resolution " + std::to_string(width) + "," + std::to_string(height) +
                     ": this driver draws from 1 to " + std::to_string(most) + " pixels per side");
}

void checkSamples(int samples) {
  if (samples < 1)
    throw InputError("--anti-aliasing msaa:" + std::to_string(samples) +
                     ": give at least 1 sample");
  if (samples == 1) return;
  const int most = maxSamples();
  if (samples <= most) return;
  const int side = int(std::ceil(std::sqrt(double(samples))));
  throw InputError(
      "--anti-aliasing msaa:" + std::to_string(samples) + ": this driver has " +
      (most > 1 ? "at most " + std::to_string(most) + " samples" : "no multisampling") +
      ": use --anti-aliasing ssaa:" + std::to_string(side));
}

Program resolveProgram(int samples) {
  const std::string vertex = R"(#version 330 core
void main() {
  gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);
})";
  const std::string fragment = "#version 330 core\n#define SAMPLES " + std::to_string(samples) +
                               R"(
uniform sampler2DMS drawn;
out vec4 mean;
void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec4 sum = texelFetch(drawn, pixel, 0);
  for (int i = 1; i < SAMPLES; ++i) sum += texelFetch(drawn, pixel, i);
  mean = sum * (1.0 / float(SAMPLES));
})";
  const ShaderSource sources[] = {{GL_VERTEX_SHADER, vertex}, {GL_FRAGMENT_SHADER, fragment}};
  Program program("resolve", sources);
  program.bindSampler("drawn", 0);
  return program;
}

}  // namespace

void checkFramebuffer() {
  const GLenum status = glCheckFramebufferStatus(GL_FRAMEBUFFER);
  if (status != GL_FRAMEBUFFER_COMPLETE)
    throw Error(std::string("the driver cannot make the framebuffer: ") + statusWords(status));
}

int maxSamples() {
  GLint announced = 0, drawn = 0, read = 0;
  glGetIntegerv(GL_MAX_SAMPLES, &announced);
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &drawn);
  glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &read);
  int samples = 0;
  for (int wanted = announced; wanted > 1 && !samples; wanted /= 2) samples = trySamples(wanted);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, GLuint(drawn));
  glBindFramebuffer(GL_READ_FRAMEBUFFER, GLuint(read));
  return std::max(samples, 1);
}

RenderTarget::RenderTarget(int width, int height, int samples) : width_(width), height_(height) {
  requireContext("making a framebuffer");
  checkSize(width, height);
  checkSamples(samples);
  checkGl("before making a framebuffer");
  const int multi = samples > 1 ? samples : 0;
  color_ = Renderbuffer::make();
  drawn_ = Framebuffer::make();
  makeStorage(color_, GL_RGBA32F, width, height, 0);
  if (multi) {
    single_ = Framebuffer::make();
    glBindFramebuffer(GL_FRAMEBUFFER, single_.id());
    attach(GL_COLOR_ATTACHMENT0, color_);
    checkGl("making a framebuffer");
    checkFramebuffer();
    samplesColor_ = TextureHandle::make();
    samples_ = std::max(makeStorage(samplesColor_, GL_RGBA32F, width, height, multi), 1);
    resolve_ = resolveProgram(samples_);
    noVertices_ = VertexArray::make();
  }
  depth_ = makeDepths();
  glBindFramebuffer(GL_FRAMEBUFFER, drawn_.id());
  attachColors();
  attachDepths(depth_);
  checkGl("making a framebuffer");
  checkFramebuffer();
  bind();
}

TextureHandle RenderTarget::makeDepths() const {
  TextureHandle depths = TextureHandle::make();
  makeStorage(depths, GL_DEPTH_COMPONENT32F, width_, height_, samples_ > 1 ? samples_ : 0);
  return depths;
}

void RenderTarget::attachDepths(const TextureHandle& depths) const {
  attach(GL_DEPTH_ATTACHMENT, depths, textureTarget());
}

void RenderTarget::attachColors() const {
  if (samples_ > 1)
    attach(GL_COLOR_ATTACHMENT0, samplesColor_, GL_TEXTURE_2D_MULTISAMPLE);
  else
    attach(GL_COLOR_ATTACHMENT0, color_);
}

void RenderTarget::bind() const {
  glBindFramebuffer(GL_FRAMEBUFFER, drawn_.id());
  glViewport(0, 0, width_, height_);
}

std::vector<glm::vec2> RenderTarget::samplePositions() const {
  if (samples_ <= 1) return {};
  bind();
  std::vector<glm::vec2> positions(static_cast<std::size_t>(samples_));
  for (std::size_t i = 0; i < positions.size(); ++i)
    glGetMultisamplefv(GL_SAMPLE_POSITION, GLuint(i), &positions[i].x);
  return positions;
}

void RenderTarget::resolve() const {
  if (samples_ <= 1) return;
  glBindFramebuffer(GL_FRAMEBUFFER, single_.id());
  glDisable(GL_BLEND);
  glDisable(GL_CULL_FACE);
  glDisable(GL_DEPTH_TEST);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D_MULTISAMPLE, samplesColor_.id());
  resolve_.use();
  glBindVertexArray(noVertices_.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

void RenderTarget::read(float* rgba, int width, int height, int stride) const {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, resolved());
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  glPixelStorei(GL_PACK_ROW_LENGTH, stride);
  const bool turns = GLINT_GLAD_GL_MESA_pack_invert != 0;
  if (turns) glPixelStorei(GL_PACK_INVERT_MESA, GL_TRUE);
  glReadPixels(0, 0, width, height, GL_RGBA, GL_FLOAT, rgba);
  if (turns) glPixelStorei(GL_PACK_INVERT_MESA, GL_FALSE);
  glPixelStorei(GL_PACK_ROW_LENGTH, 0);
  if (turns) return;
  const auto row = [&](int y) { return rgba + std::size_t(4) * stride * std::size_t(y); };
  for (int y = 0; y < height / 2; ++y)
    std::swap_ranges(row(y), row(y) + std::size_t(4) * width, row(height - 1 - y));
}

}  // namespace glint
