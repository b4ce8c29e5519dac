#pragma once

#include <map>
#include <string>

namespace glint {

/// The files of glsl/ as they were when this was built, by name.
const std::map<std::string, std::string>& builtinGlsl();

}  // namespace glint
