#include <cstdio>
#include <cstring>

#include "glint/gl/context.h"
#include "glint/image/error.h"
#include "glint/render/renderer.h"

/// Returns 0 if a renderer reports that there is no context, and starts once there is one.
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
