#include "glint/shading/specular_filter.h"

#include <algorithm>

#include "glint/shading/safe.h"

namespace glint {

FilteredLobe filteredLobe(double exponent, bool blinn, double turn) {
  const double perBlinn = blinn ? 1 : 4;
  const double squareWidth = 2 / (perBlinn * clampTo(exponent, 0, 1e9) + 2);
  const double widening = std::min(2 * pixelVariance * clampTo(turn, 0, 1e9), largestWidening);
  const double wider = std::min(squareWidth + widening, 1.0);  // the width for exponent 0
  return {(2 / wider - 2) / perBlinn, squareWidth / wider};
}

FilteredLobe toksvigLobe(double exponent, bool blinn, double variance) {
  const double given = clampTo(exponent, 0, 1e9), perBlinn = blinn ? 1 : 4;
  const double filtered = given / (1 + perBlinn * given * clampTo(variance, 0, 1e9));
  return {filtered, (1 + filtered) / (1 + given)};
}

}  // namespace glint
