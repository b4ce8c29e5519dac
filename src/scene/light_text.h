#pragma once

#include <string>

#include "glint/scene/look.h"

namespace glint {

/// A light from the text of --light: parseLight() with, for points and spots, what makes them fall
/// off as a file's do: "falloff" or "falloff,RANGE" as the last field. Throws InputError.
Light readLight(const std::string& text);

/// The text that gives the same light again.
std::string writeLight(const Light&);

}  // namespace glint
