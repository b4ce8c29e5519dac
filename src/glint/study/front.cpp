#include "glint/study/front.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace glint {

bool isFaster(std::span<const double> a, std::span<const double> b, double spread) {
  const TimeRatio ratio = timeRatio(a, b);
  return ratio.value > 0 && ratio.high * (1 + spread) < 1;
}

std::vector<FrontPlace> paretoFront(std::span<const double> errors,
                                    const std::function<bool(int, int)>& isFasterThan) {
  std::vector<int> order(errors.size());
  std::iota(order.begin(), order.end(), 0);
  const auto error = [&](int i) { return errors[std::size_t(i)]; };
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return error(a) < error(b); });
  std::vector<FrontPlace> places(errors.size());
  int last = -1;
  for (const int i : order) {
    FrontPlace& place = places[std::size_t(i)];
    if (last >= 0 && !isFasterThan(i, last)) {
      place.dominatedBy = last;
      continue;
    }
    if (last >= 0 && error(i) <= error(last) * (1 + sameError)) {
      for (FrontPlace& other : places)
        if (other.dominatedBy == last) other.dominatedBy = i;
      places[std::size_t(last)] = {false, i};
    }
    place.onFront = true;
    last = i;
  }
  for (std::size_t i = 0; i < places.size(); ++i)
    if (places[i].dominatedBy >= 0)
      places[i].isSlower = isFasterThan(places[i].dominatedBy, int(i));
  return places;
}

std::vector<FrontPlace> paretoFront(std::span<const FrontCandidate> candidates, double spread) {
  std::vector<double> errors;
  for (const FrontCandidate& each : candidates) errors.push_back(each.error);
  return paretoFront(errors, [&](int a, int b) {
    return isFaster(candidates[std::size_t(a)].rounds, candidates[std::size_t(b)].rounds, spread);
  });
}

double spreadOfControls(std::span<const TimeRatio> ratios) {
  double spread = 0;
  for (const TimeRatio& ratio : ratios)
    if (ratio.value > 0)
      spread = std::max({spread, std::abs(ratio.high - 1), std::abs(ratio.low - 1)});
  return spread;
}

}  // namespace glint
