#include "choice.h"

#include <algorithm>
#include <utility>

#include "document.h"

namespace glint::viewer {
namespace {

constexpr std::size_t most = 4;  // A and B, each before and now

// A choice concerns light at one sample before exposure; none of these affects it.
Look withoutRest(Look look) {
  const Look plain;
  look.antiAliasing = plain.antiAliasing;
  look.exposure = plain.exposure;
  look.backgroundColor = plain.backgroundColor;
  look.noBackground = plain.noBackground;
  return look;
}

}  // namespace

bool leavesOpen(const Look& look) {
  return look.maxError.has_value() || look.shading == Shading::automatic;
}

std::shared_ptr<const ResolvedLook> Chooser::choose(const Scene& scene, const Bounds& bounds,
                                                    Look look, glm::ivec2 size, bool moves) {
  look.resolution = size;
  look = withoutRest(std::move(look));
  auto found = std::ranges::find(kept_, look, &Kept::look);
  if (found == kept_.end() && moves) {
    const Look still = withoutCamera(look);
    found = std::ranges::find_if(kept_, [&](const Kept& k) {
      return k.look.resolution == size && withoutCamera(k.look) == still;
    });
  }
  if (found == kept_.end()) {
    kept_.push_front(
        {look, std::make_shared<const ResolvedLook>(resolveLook(scene, bounds, look))});
    if (kept_.size() > most) kept_.pop_back();
  } else {
    kept_.splice(kept_.begin(), kept_, found);
  }
  return kept_.front().choice;
}

}  // namespace glint::viewer
