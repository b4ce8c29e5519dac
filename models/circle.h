#pragma once

#include <glm/glm.hpp>

namespace glint::models {

/// (cos, sin) of k/n turns, n a multiple of 8; the same digits on every machine.
glm::dvec2 onCircle(int k, int n);

}  // namespace glint::models
