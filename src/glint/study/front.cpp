#include "glint/study/front.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace glint {

bool isFaster(std::span<const double> a, std::span<const double> b, double spread) {
  const TimeRatio ratio = timeRatio(a, b);
  return ratio.value > 0 && ratio.high * (1 + spread) < 1;
}

std::vector<FrontPlace> paretoFront(std::span<const FrontCandidate> candidates, double spread) {
  std::vector<int> order(candidates.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return candidates[std::size_t(a)].error < candidates[std::size_t(b)].error;
  });
  std::vector<FrontPlace> places(candidates.size());
  int last = -1;
  for (const int i : order) {
    const FrontCandidate& candidate = candidates[std::size_t(i)];
    FrontPlace& place = places[std::size_t(i)];
    if (last < 0) {
      place.onFront = true;
      last = i;
      continue;
    }
    const FrontCandidate& best = candidates[std::size_t(last)];
    if (!isFaster(candidate.rounds, best.rounds, spread)) {
      place.dominatedBy = last;
      continue;
    }
    if (candidate.error <= best.error * (1 + sameError)) {
      for (FrontPlace& other : places)
        if (other.dominatedBy == last) other.dominatedBy = i;
      places[std::size_t(last)] = {false, i};
    }
    place.onFront = true;
    last = i;
  }
  return places;
}

double spreadOfControls(std::span<const TimeRatio> ratios) {
  double spread = 0;
  for (const TimeRatio& ratio : ratios)
    if (ratio.value > 0)
      spread = std::max({spread, std::abs(ratio.high - 1), std::abs(ratio.low - 1)});
  return spread;
}

}  // namespace glint
