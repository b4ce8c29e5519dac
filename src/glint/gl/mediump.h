#pragma once

#include <string>

#include "glint/gl/context.h"

namespace glint {

/// The precision in which a driver computes `mediump`, which phones and browsers use in OpenGL ES.
struct MediumpReport {
  bool isHalf = false;   ///< 16 bits; otherwise more, which OpenGL ES allows
  std::string renderer;  ///< the driver's name
};

/// Tests this in an OpenGL ES 3 context from EGL: (x + 1) - 1 with x = 2^-12, which is lost in
/// halves. The calling thread must have no context current, and has none afterwards. Throws
/// ContextError if there is no such context.
MediumpReport mediumpOfDriver();

}  // namespace glint
