#include "glint/gl/check.h"

#include <glad/gl.h>

#include <cstdio>
#include <string>

#include "glint/image/error.h"

namespace glint {

namespace {

constexpr GLenum contextLost = 0x0507;  // GL 4.5, GL_KHR_robustness

std::string errorWords(GLenum code) {
  switch (code) {
    case GL_OUT_OF_MEMORY:
      return "out of memory (GL_OUT_OF_MEMORY): use a smaller --resolution or fewer samples";
    case contextLost:
      return "the device was reset and the context is lost (GL_CONTEXT_LOST)";
    case GL_INVALID_ENUM:
      return "GL_INVALID_ENUM, a name that this driver does not know";
    case GL_INVALID_VALUE:
      return "GL_INVALID_VALUE, a number out of range";
    case GL_INVALID_OPERATION:
      return "GL_INVALID_OPERATION, not allowed in this state";
    case GL_INVALID_FRAMEBUFFER_OPERATION:
      return "GL_INVALID_FRAMEBUFFER_OPERATION, the framebuffer is not complete";
    default:
      break;
  }
  char number[32];
  std::snprintf(number, sizeof number, "GL error 0x%04x", code);
  return number;
}

}  // namespace

void checkGl(const char* where) {
  // A driver may record several errors; one with a lost context may report it forever.
  constexpr int most = 16;
  if (glGetError == nullptr) requireContext(where);
  std::string words;
  GLenum last = GL_NO_ERROR;
  for (int i = 0; i < most; ++i) {
    const GLenum code = glGetError();
    if (code == GL_NO_ERROR || code == last) break;
    words += (words.empty() ? "" : "; ") + errorWords(code);
    last = code;
  }
  if (!words.empty()) throw Error(std::string(where) + ": " + words);
}

void requireContext(const char* where) {
  if (glGetString == nullptr || glGetString(GL_VERSION) == nullptr)
    throw Error(
        std::string(where) +
        ": no OpenGL context is current in this thread: open one and make it current first");
}

}  // namespace glint
