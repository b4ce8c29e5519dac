#include "glint/shading/costs.h"

#include <algorithm>
#include <bit>

namespace glint {
namespace {

template <std::size_t Count>
double at(const std::array<double, Count>& costs, int index) {
  return costs[std::size_t(std::clamp(index, 0, int(Count) - 1))];
}

}  // namespace

int productsOf(int power) {
  if (power < 2) return 0;
  return std::bit_width(unsigned(power)) - 1 + std::popcount(unsigned(power)) - 1;
}

double CostTable::lobe(LobeForm form, int power) const {
  const int squarings = power > 1 ? std::bit_width(unsigned(power)) - 1 : 0;
  switch (form) {
    case LobeForm::exact:
      return exact;
    case LobeForm::pow:
      return pow;
    case LobeForm::integer:
      return at(integer, productsOf(power));
    case LobeForm::lyon:
    case LobeForm::lyonTuned:
      return at(lyon, squarings);
    case LobeForm::lyonCross:
      return at(lyonCross, squarings);
    case LobeForm::pade:
      return at(pade, squarings);
    case LobeForm::gaussian:
      return gaussian;
    case LobeForm::none:
      return 0;
  }
  return exact;
}

double CostTable::reflectance(FresnelForm form, double exponent, bool denserSide) const {
  const ReflectanceCosts& costs = denserSide ? fresnelDenser : fresnel;
  switch (form) {
    case FresnelForm::exact:
      return costs.exact;
    case FresnelForm::textbook:
      return costs.textbook;
    case FresnelForm::schlick:
      return exponent == 5.0 ? costs.schlick : costs.schlickExponent;
    case FresnelForm::schlickExp2:
      return costs.schlickExp2;
    case FresnelForm::rational:
      return costs.rational;
  }
  return costs.exact;
}

}  // namespace glint
