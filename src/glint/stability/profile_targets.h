#pragma once

#include "glint/stability/profile.h"

namespace glint::stability {

std::string shortText(double x);

/// A quality that is told as it is, where nothing states how exact it has to be.
Quality observed(std::string name, std::string measured, std::string result, std::string required,
                 std::string verdict, std::string touches, bool weak = false);

/// What the driver's targets store and hold: sRGB, samples, depth, limits.
void measureTargets(std::vector<Quality>& all);

}  // namespace glint::stability
