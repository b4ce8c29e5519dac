#pragma once

#include "glint/stability/profile.h"

namespace glint::stability {

std::string shortText(double x);

/// A quality that is only reported, where nothing specifies how exact it must be.
Quality observed(std::string name, std::string measured, std::string result, std::string required,
                 std::string verdict, std::string touches, bool weak = false);

/// Measures what the driver's targets store and hold: sRGB, samples, depth, limits.
void measureTargets(std::vector<Quality>& all);

}  // namespace glint::stability
