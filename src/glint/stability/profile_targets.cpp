#include "glint/stability/profile_targets.h"

#include <glad/gl.h>

#include <algorithm>
#include <array>
#include <cstdio>

#include "glint/gl/framebuffer.h"
#include "glint/gl/program.h"
#include "glint/image/srgb.h"

namespace glint::stability {

std::string shortText(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", x);
  return text;
}

namespace {

/// How many codes an sRGB renderbuffer stores differently from glint's encoding; -1 without such a
/// target.
int storedOtherwise() {
  constexpr int width = 1024;
  const Renderbuffer buffer = Renderbuffer::make();
  const Framebuffer framebuffer = Framebuffer::make();
  const VertexArray array = VertexArray::make();
  glBindRenderbuffer(GL_RENDERBUFFER, buffer.id());
  glRenderbufferStorage(GL_RENDERBUFFER, GL_SRGB8_ALPHA8, width, 1);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, buffer.id());
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) return -1;
  const ShaderSource sources[] = {
      {GL_VERTEX_SHADER,
       "#version 330 core\nvoid main() {\n  gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, "
       "gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);\n}\n"},
      {GL_FRAGMENT_SHADER,
       "#version 330 core\nout vec4 color;\nvoid main() {\n  color = vec4(vec3((gl_FragCoord.x - "
       "0.5) / 1023.0), 1.0);\n}\n"}};
  const Program program("store", sources);
  for (GLenum state : {GL_DEPTH_TEST, GL_BLEND, GL_CULL_FACE, GL_DITHER}) glDisable(state);
  glViewport(0, 0, width, 1);
  program.use();
  glBindVertexArray(array.id());
  glEnable(GL_FRAMEBUFFER_SRGB);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glDisable(GL_FRAMEBUFFER_SRGB);
  std::array<std::uint8_t, 4 * width> codes{};
  glReadPixels(0, 0, width, 1, GL_RGBA, GL_UNSIGNED_BYTE, codes.data());
  int otherwise = 0;
  for (int i = 0; i < width; ++i)
    otherwise += codes[std::size_t(4 * i)] != encodeSrgb8(float(i) / 1023.0f);
  return otherwise;
}

}  // namespace

void measureTargets(std::vector<Quality>& all) {
  const int otherwise = storedOtherwise();
  all.push_back(
      {"sRGB store", "1024 values into an sRGB target",
       otherwise < 0 ? "no such target" : std::to_string(otherwise) + " codes are not the nearest",
       "0.6 of a code in practice; not stated", otherwise == 0 ? "exact" : "not exact",
       "nothing: pictures are encoded on the CPU", otherwise > 0});
  const int samples = maxSamples();
  std::string positions;
  if (samples > 1) {
    const RenderTarget target(4, 4, std::min(samples, 4));
    for (int i = 0; i < target.samples(); ++i) {
      GLfloat at[2] = {0, 0};
      glGetMultisamplefv(GL_SAMPLE_POSITION, GLuint(i), at);
      positions += (i ? " " : "") + shortText(at[0]) + "," + shortText(at[1]);
    }
  }
  all.push_back({"samples", "the most a float target has; where they are",
                 std::to_string(samples) + (positions.empty() ? "" : ": " + positions),
                 "4 of GL 3.0 for plain formats", samples >= 4 ? "as required" : "fewer",
                 "--anti-aliasing msaa; ssaa does without", samples < 4});
  all.push_back({"depth", "GL_ARB_clip_control, float depth",
                 GLINT_GLAD_GL_ARB_clip_control ? "reversed float depth" : "no clip control",
                 "an extension of 3.3",
                 GLINT_GLAD_GL_ARB_clip_control ? "1e-7 of the distance everywhere"
                                                : "coarse far from the near plane",
                 "cases G1 and G2", !GLINT_GLAD_GL_ARB_clip_control});
  GLint size = 0, texture = 0, block = 0;
  glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &size);
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &texture);
  glGetIntegerv(GL_MAX_UNIFORM_BLOCK_SIZE, &block);
  all.push_back({"limits", "target, texture, uniform block",
                 std::to_string(size) + ", " + std::to_string(texture) + " pixels per side, " +
                     std::to_string(block) + " bytes",
                 "1024, 1024, 16384", "as required",
                 "cases L1 to L6: drawn in parts, smaller, or refused by name"});
}

}  // namespace glint::stability
