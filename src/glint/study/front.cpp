#include "glint/study/front.h"

#include <algorithm>
#include <cmath>

namespace glint {

namespace {

bool isBelow(const TimeRatio& ratio, double spread) {
  return ratio.value > 0 && ratio.high * (1 + spread) < 1;
}

}  // namespace

bool isFaster(std::span<const double> a, std::span<const double> b, double spread) {
  return isBelow(timeRatio(a, b), spread);
}

bool isFaster(const QuartileSamples& a, const QuartileSamples& b, double spread) {
  return isBelow(timeRatio(a, b), spread);
}

std::vector<FrontPlace> paretoFront(std::span<const double> errors,
                                    const std::function<bool(int, int)>& isFasterThan,
                                    const std::function<bool(int)>& isRival) {
  std::vector<FrontPlace> places(errors.size());
  const int count = int(errors.size());
  for (int i = 0; i < count; ++i) {
    FrontPlace& place = places[std::size_t(i)];
    place.onFront = true;
    for (int j = 0; j < count; ++j) {
      if (j == i || (isRival && !isRival(j))) continue;
      if (!(errors[std::size_t(j)] <= errors[std::size_t(i)] * (1 + sameError))) continue;
      if (isFasterThan(i, j)) continue;
      const bool isSlower = isFasterThan(j, i);
      // A rival that is certainly faster is named before one that may be, and the fastest of each
      // kind.
      const bool first = place.onFront || (isSlower && !place.isSlower);
      place.onFront = false;
      if (!first && (isSlower != place.isSlower || !isFasterThan(j, place.dominatedBy))) continue;
      place.dominatedBy = j;
      place.isSlower = isSlower;
    }
  }
  return places;
}

std::vector<FrontPlace> paretoFront(std::span<const FrontCandidate> candidates, double spread) {
  std::vector<double> errors;
  std::vector<QuartileSamples> samples;
  for (const FrontCandidate& each : candidates) {
    errors.push_back(each.error);
    samples.push_back(quartileSamples(each.rounds));
  }
  return paretoFront(errors, [&](int a, int b) {
    return isFaster(samples[std::size_t(a)], samples[std::size_t(b)], spread);
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
