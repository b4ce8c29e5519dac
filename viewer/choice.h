#pragma once

#include <list>
#include <memory>

#include "glint/budget/error_budget.h"

namespace glint::viewer {

/// Whether the forms or the program of a look are still to be chosen, by --max-error or --shading
/// auto.
bool leavesOpen(const Look&);

/// Caches what resolveLook() chooses for looks at a scene, until its inputs change.
class Chooser {
 public:
  /// `size` is the resolution to choose for: that of the whole picture even while a smaller one is
  /// drawn for speed. While something `moves`, a choice for another camera is good enough.
  std::shared_ptr<const ResolvedLook> choose(const Scene&, const Bounds&, Look, glm::ivec2 size,
                                             bool moves);
  /// Call this when the scene is replaced.
  void forget() { kept_.clear(); }

 private:
  struct Kept {
    Look look;
    std::shared_ptr<const ResolvedLook> choice;
  };
  std::list<Kept> kept_;  ///< most recently used first
};

}  // namespace glint::viewer
