#pragma once

#include <ostream>

#include "glint/gl/context.h"

namespace glint {

/// As GoogleTest prints the parameter of a test.
inline void PrintTo(Backend backend, std::ostream* out) { *out << backendName(backend); }

}  // namespace glint
