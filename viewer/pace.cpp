#include "pace.h"

#include <algorithm>

namespace glint::viewer {

Look Pace::faster(const Look& look) const {
  Look fast = look;
  fast.antiAliasing = {AntiAliasing::Mode::none, 1};
  fast.resolution = glm::max((look.resolution + division_ - 1) / division_, glm::ivec2(1));
  return fast;
}

double Pace::rest() const { return std::clamp(whole_ / 2000, restAfter, 0.6); }

void Pace::drewWhole(double ms, bool cold) {
  if (!cold || whole_ == 0) whole_ = ms;
  learnAnew();
}

void Pace::learnAnew() {
  useful_ = most;
  larger_ = 0;
  tries_ = 0;
  slow_ = {};
}

void Pace::drewFaster(double ms, bool cold) {
  if (cold) return;
  const double d = division_;
  if (ms > slowFrame) {
    slow_[std::size_t(division_)] = true;
    least_ = tries_++ > 0 ? std::min(least_, ms) : ms;
    if (larger_ > 0 && least_ > 0.85 * larger_) {
      if (tries_ < 3) return;  // other work may have delayed it
      useful_ = std::max(1, division_ - 1);
      division_ = useful_;
      larger_ = 0;
    } else if (division_ < std::min(most, useful_)) {
      larger_ = ms;
      ++division_;
    }
    tries_ = 0;
  } else if (division_ > 1 && ((ms < 0.7 * slowFrame && !slow_[std::size_t(division_ - 1)]) ||
                               ms * d * d < 0.6 * slowFrame * (d - 1) * (d - 1))) {
    // Tries a larger picture once, because the share of time spent on pixels is unknown, and again
    // if pixels may be all of it.
    --division_;
    larger_ = 0;
    tries_ = 0;
  } else {
    larger_ = 0;
  }
}

}  // namespace glint::viewer
