#include "glint/shading/specular_filter.h"

#include <algorithm>

#include "glint/shading/safe.h"

namespace glint {

FilteredLobe filteredLobe(double exponent, bool blinn, double turn) {
  const double perBlinn = blinn ? 1 : 4;
  const double squareWidth = 2 / (perBlinn * clampTo(exponent, 0, 1e9) + 2);
  const double widening = std::min(2 * pixelVariance * clampTo(turn, 0, 1e9), largestWidening);
  const double wider = std::min(squareWidth + widening, 1.0);  // that of the exponent 0
  return {(2 / wider - 2) / perBlinn, squareWidth / wider};
}

}  // namespace glint
