#include <cstdio>
#include <cstring>

#include "glint/gl/context.h"
#include "glint/image/error.h"
#include "glint/render/renderer.h"

/// 0 if a renderer says what it lacks before there is a context, and starts with one.
extern "C" int embedded() {
  try {
    glint::Renderer tooEarly;
    return 1;
  } catch (const glint::Error& error) {
    if (std::strstr(error.what(), "no OpenGL context is current") == nullptr) return 2;
  }
  const auto context = glint::openContext(glint::Backend::osmesa);
  context->makeCurrent();
  const glint::Renderer renderer;
  std::puts(glint::glStrings().renderer.c_str());
  return 0;
}
