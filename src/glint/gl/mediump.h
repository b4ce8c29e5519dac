#pragma once

#include <string>

#include "glint/gl/context.h"

namespace glint {

/// What a driver computes `mediump` numbers in, as phones and browsers ask for by OpenGL ES.
struct MediumpReport {
  bool isHalf = false;   ///< 16 bits; otherwise more, as OpenGL ES allows
  std::string renderer;  ///< the driver's name
};

/// Finds it out in an OpenGL ES 3 context of EGL's, by (x + 1) - 1 of x = 2^-12, which halves lose.
/// No context may be current on the calling thread; none is afterwards. Throws ContextError where
/// there is no such context.
MediumpReport mediumpOfDriver();

}  // namespace glint
