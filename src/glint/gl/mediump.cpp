#include "glint/gl/mediump.h"

#include "glint/gl/backends.h"
#include "glint/gl/handles.h"
#include "glint/gl/program.h"

namespace glint {
namespace {

constexpr const char* wholeTriangle = R"(#version 300 es
void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  gl_Position = vec4(4.0 * corner - 1.0, 0.0, 1.0);
}
)";

// Green if x was lost.
constexpr const char* lossShader = R"(#version 300 es
precision mediump float;
uniform float x;
out vec4 color;
void main() {
  float left = (x + 1.0) - 1.0;
  color = vec4(0.0, left == 0.0 ? 1.0 : 0.0, 0.0, 1.0);
}
)";

}  // namespace

MediumpReport mediumpOfDriver() {
  const std::unique_ptr<Context> context = backends::openSystemEs3();
  context->makeCurrent();
  const ShaderSource sources[] = {{GL_VERTEX_SHADER, wholeTriangle},
                                  {GL_FRAGMENT_SHADER, lossShader}};
  const Program program("mediump", sources);
  const Renderbuffer buffer = Renderbuffer::make();
  const Framebuffer target = Framebuffer::make();
  const VertexArray nothing = VertexArray::make();
  glBindRenderbuffer(GL_RENDERBUFFER, buffer.id());
  glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, 1, 1);
  glBindFramebuffer(GL_FRAMEBUFFER, target.id());
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, buffer.id());
  glViewport(0, 0, 1, 1);
  glBindVertexArray(nothing.id());
  program.use();
  glUniform1f(program.uniform("x"), 0x1p-12f);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  GLubyte pixel[4] = {};
  glReadPixels(0, 0, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel);
  return {pixel[1] > 127, glStrings().renderer};
}

}  // namespace glint
