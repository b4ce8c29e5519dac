#include "circle.h"

#include <cassert>
#include <numbers>

namespace glint::models {

// Reduced to half a quadrant, so that symmetric points have the same digits and the axes are met
// exactly. Summed as Taylor series instead of calling libm, so that the files do not depend on the
// library that the program runs with.
glm::dvec2 onCircle(int k, int n) {
  assert(n % 8 == 0);
  k = ((k % n) + n) % n;
  if (k > n / 2) {
    const glm::dvec2 p = onCircle(n - k, n);
    return {p.x, -p.y};
  }
  if (k > n / 4) {
    const glm::dvec2 p = onCircle(n / 2 - k, n);
    return {-p.x, p.y};
  }
  if (k > n / 8) {
    const glm::dvec2 p = onCircle(n / 4 - k, n);
    return {p.y, p.x};
  }
  const double angle = 2.0 * std::numbers::pi * k / n;  // at most pi/4
  glm::dvec2 sum{0.0};
  double term = 1.0;
  for (int i = 0; i < 20; ++i) {  // the first term left out is below (pi/4)^20 / 20! = 4e-21
    (i % 2 == 0 ? sum.x : sum.y) += i % 4 < 2 ? term : -term;
    term *= angle / (i + 1);
  }
  return sum;
}

}  // namespace glint::models
