#pragma once

#include <ostream>

#include "glint/gl/context.h"

namespace glint {

/// How GoogleTest prints a test's parameter.
inline void PrintTo(Backend backend, std::ostream* out) { *out << backendName(backend); }

}  // namespace glint
