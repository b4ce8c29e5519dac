#include "glint/shading/costs.h"

#include <algorithm>
#include <bit>

namespace glint {

CostTable::CostTable() {
  for (const HighlightRow& each : highlightRows())
    if (!each.costs.empty()) lobes[each.form].assign(each.costs.begin(), each.costs.end());
}

int productsOf(int power) {
  if (power < 2) return 0;
  return std::bit_width(unsigned(power)) - 1 + std::popcount(unsigned(power)) - 1;
}

double CostTable::lobe(Highlight form, int power) const {
  const auto found = lobes.find(row(form).costsAs);
  if (found == lobes.end()) return 0;
  const int least = std::max(row(form).leastGamma, 1);
  const int doublings = power > least ? std::bit_width(unsigned(power / least)) - 1 : 0;
  const int index = row(form).wholePowers ? productsOf(power) : doublings;
  return found->second[std::size_t(std::clamp(index, 0, int(found->second.size()) - 1))];
}

double CostTable::reflectance(Fresnel form, double exponent, bool denserSide) const {
  const ReflectanceCosts& costs = denserSide ? fresnelDenser : fresnel;
  if (form == Fresnel::schlick && exponent != 5.0) return costs.schlickExponent;
  return costs.*row(form).cost;
}

}  // namespace glint
