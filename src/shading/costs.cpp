#include "glint/shading/costs.h"

#include <bit>

namespace glint {

double lobeCost(LobeForm form, int gamma) {
  const int steps = gamma > 1 ? std::bit_width(unsigned(gamma)) - 1 : 0;
  switch (form) {
    case LobeForm::exact:
      return 100;
    case LobeForm::pow:
      return 110;
    case LobeForm::integer:  // a squaring a bit, and a product for each bit that is set
      return 20 + 2.0 * (steps + std::popcount(unsigned(gamma)) - 1);
    case LobeForm::lyon:
    case LobeForm::lyonTuned:
      return 22 + 2.0 * steps;
    case LobeForm::lyonCross:
      return 26 + 2.0 * steps;
    case LobeForm::pade:
      return 34 + 2.0 * steps;
    case LobeForm::gaussian:
      return 45;
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
      return schlickExponent == 5.0 ? 40 : 110;
    case FresnelForm::schlickExp2:
      return 60;
    case FresnelForm::rational:
      return 50;
  }
  return 100;
}

}  // namespace glint
