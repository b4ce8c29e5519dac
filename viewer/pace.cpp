#include "pace.h"

#include <algorithm>

namespace glint::viewer {

Look Pace::faster(const Look& look) const {
  Look fast = look;
  fast.antiAliasing = {AntiAliasing::Mode::none, 1};
  fast.resolution = glm::max((look.resolution + division_ - 1) / division_, glm::ivec2(1));
  return fast;
}

void Pace::drewWhole(double ms, bool cold) {
  if (!cold || whole_ == 0) whole_ = ms;
}

void Pace::drewFaster(double ms, bool cold) {
  if (cold) return;
  const double d = division_;
  if (ms > slowFrame) {
    if (larger_ > 0 && ms > 0.85 * larger_) {
      useful_ = std::max(1, division_ - 1);
      division_ = useful_;
      larger_ = 0;
    } else if (division_ < std::min(most, useful_)) {
      larger_ = ms;
      ++division_;
    }
  } else if (division_ > 1 && ms * d * d < 0.6 * slowFrame * (d - 1) * (d - 1)) {
    --division_;
    larger_ = 0;
  } else {
    larger_ = 0;
  }
}

}  // namespace glint::viewer
