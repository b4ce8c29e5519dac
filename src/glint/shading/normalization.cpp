#include "glint/shading/normalization.h"

#include <cmath>

#include "glint/shading/safe.h"

namespace glint {

double lobeNormalization(Normalization kind, bool blinn, double exponent) {
  const double n = clampTo(exponent, 0.0, 1e9);
  switch (kind) {
    case Normalization::none:
      break;
    case Normalization::simple:
      return blinn ? (n + 8) / 8 : (n + 2) / 2;
    case Normalization::exact:
      return blinn ? (n + 2) / (4 * (2 - std::exp2(-n / 2))) : (n + 1) / 2;
  }
  return 1;
}

std::string_view normalizationGlsl(Normalization kind, bool blinn) {
  if (kind == Normalization::simple) return blinn ? "blinnNormalization" : "phongNormalization";
  return blinn ? "exactBlinnNormalization" : "exactPhongNormalization";
}

}  // namespace glint
