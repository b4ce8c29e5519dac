#pragma once

#include <list>
#include <memory>

#include "glint/budget/error_budget.h"

namespace glint::viewer {

/// Whether forms or the program of a look are still to be chosen: by --max-error or --shading auto.
bool leavesOpen(const Look&);

/// What resolveLook() chooses for looks at a scene, kept for as long as what it depends on stays.
class Chooser {
 public:
  /// `size` is the resolution to choose for, that of the whole picture while a smaller one is drawn
  /// for speed. While something `moves`, a choice for another camera is good enough.
  std::shared_ptr<const ResolvedLook> choose(const Scene&, const Bounds&, Look, glm::ivec2 size,
                                             bool moves);
  /// To be called when the scene is another.
  void forget() { kept_.clear(); }

 private:
  struct Kept {
    Look look;
    std::shared_ptr<const ResolvedLook> choice;
  };
  std::list<Kept> kept_;  ///< the last used first
};

}  // namespace glint::viewer
