#include "glint/study/front.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "glint/study/statistics.h"

namespace glint {

bool isFaster(std::span<const double> a, std::span<const double> b, double spread) {
  const auto ratios = roundRatios({a.begin(), a.end()}, {b.begin(), b.end()});
  return !ratios.empty() && medianInterval(ratios).high * (1 + spread) < 1;
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

double spreadOfControls(std::span<const std::vector<double>> ratios) {
  double spread = 0;
  for (const auto& of : ratios) {
    if (of.empty()) continue;
    const Interval interval = medianInterval(of);
    spread = std::max({spread, std::abs(interval.high - 1), std::abs(interval.low - 1)});
  }
  return spread;
}

}  // namespace glint
