#include "glint/shading/costs.h"

#include <bit>

namespace glint {

// Levels as measured on llvmpipe, where all forms but the exact one cost about half of it; what the
// measurement cannot tell apart is ordered by counting operations.

double lobeCost(LobeForm form, int gamma) {
  const int steps = gamma > 1 ? std::bit_width(unsigned(gamma)) - 1 : 0;
  switch (form) {
    case LobeForm::exact:
      return 100;
    case LobeForm::pow:
      return 56;
    case LobeForm::integer:  // a squaring a bit, and a product for each bit that is set
      return 43 + steps + std::popcount(unsigned(gamma)) - 1;
    case LobeForm::lyon:
    case LobeForm::lyonTuned:
      return 45 + steps;
    case LobeForm::lyonCross:
      return 47 + steps;
    case LobeForm::pade:
      return 51 + steps;
    case LobeForm::gaussian:
      return 54;
    case LobeForm::none:
      return 0;
  }
  return 100;
}

double fresnelCost(FresnelForm form, double schlickExponent) {
  switch (form) {
    case FresnelForm::exact:
      return 100;
    case FresnelForm::textbook:
      return 110;
    case FresnelForm::schlick:
      return schlickExponent == 5.0 ? 30 : 60;
    case FresnelForm::schlickExp2:
      return 45;
    case FresnelForm::rational:
      return 40;
  }
  return 100;
}

}  // namespace glint
