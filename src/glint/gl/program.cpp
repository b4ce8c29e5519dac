#include "glint/gl/program.h"

#include "glint/gl/check.h"

#include <string>
#include <vector>

#include "glint/image/error.h"

namespace glint {

namespace {

const char* stageName(GLenum stage) {
  switch (stage) {
    case GL_VERTEX_SHADER:
      return "vertex shader";
    case GL_GEOMETRY_SHADER:
      return "geometry shader";
    case GL_FRAGMENT_SHADER:
      return "fragment shader";
    default:
      return "shader";
  }
}

/// The log without trailing blanks and the terminating zero, or a placeholder if it is empty.
template <class GetParameter, class GetLog>
std::string readLog(GLuint id, GetParameter getParameter, GetLog getLog) {
  GLint length = 0;
  getParameter(id, GL_INFO_LOG_LENGTH, &length);
  std::string log(std::size_t(length > 0 ? length : 0), '\0');
  GLsizei written = 0;
  if (length > 0) getLog(id, length, &written, log.data());
  log.resize(std::size_t(written));
  while (!log.empty() && (log.back() == '\n' || log.back() == ' ')) log.pop_back();
  return log.empty() ? "the driver gives no reason" : log;
}

}  // namespace

bool fileNamesInLines() {
  requireContext("asking the driver for its name");
  GLint count = 0;
  glGetIntegerv(GL_NUM_EXTENSIONS, &count);
  for (GLint i = 0; i < count; ++i) {
    const GLubyte* name = glGetStringi(GL_EXTENSIONS, GLuint(i));
    if (name &&
        reinterpret_cast<const char*>(name) == std::string_view("GL_ARB_shading_language_include"))
      return true;
  }
  return false;
}

Program::Program(std::string_view name, std::span<const ShaderSource> sources)
    : program_(ProgramHandle::make()) {
  // Nothing is queried until all compilations have started: drivers compile on their own threads.
  std::vector<ShaderHandle> shaders;
  for (const ShaderSource& source : sources) {
    ShaderHandle shader = ShaderHandle::make(source.stage);
    const GLchar* text = source.text.data();
    const GLint length = GLint(source.text.size());
    glShaderSource(shader.id(), 1, &text, &length);
    glCompileShader(shader.id());
    glAttachShader(program_.id(), shader.id());
    shaders.push_back(std::move(shader));
  }
  glLinkProgram(program_.id());
  GLint linked = GL_FALSE;
  glGetProgramiv(program_.id(), GL_LINK_STATUS, &linked);
  if (!linked) {
    for (std::size_t i = 0; i < shaders.size(); ++i) {
      GLint compiled = GL_FALSE;
      glGetShaderiv(shaders[i].id(), GL_COMPILE_STATUS, &compiled);
      if (!compiled)
        throw Error(std::string(name) + ": " + stageName(sources[i].stage) +
                    " does not compile:\n" +
                    readLog(shaders[i].id(), glGetShaderiv, glGetShaderInfoLog));
    }
    throw Error(std::string(name) + ": the stages do not link:\n" +
                readLog(program_.id(), glGetProgramiv, glGetProgramInfoLog));
  }
  for (const ShaderHandle& shader : shaders) glDetachShader(program_.id(), shader.id());
}

bool Program::bindBlock(const char* name, GLuint binding) const {
  const GLuint index = glGetUniformBlockIndex(program_.id(), name);
  if (index == GL_INVALID_INDEX) return false;
  glUniformBlockBinding(program_.id(), index, binding);
  return true;
}

bool Program::bindSampler(const char* name, GLint unit) const {
  const GLint location = uniform(name);
  if (location < 0) return false;
  use();
  glUniform1i(location, unit);
  return true;
}

}  // namespace glint
