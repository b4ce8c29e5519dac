#pragma once

#include "glint/stability/profile.h"

namespace glint::stability {

std::string shortText(double x);

/// Measures what the driver's targets store and hold: sRGB, samples, depth, limits.
void measureTargets(std::vector<Quality>& all);

}  // namespace glint::stability
