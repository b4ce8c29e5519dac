#pragma once

#include <array>

#include "glint/scene/look.h"

namespace glint::viewer {

/// The longest a picture that follows a drag may take, ms.
inline constexpr double slowFrame = 1000.0 / 30;

/// Seconds without a change after which the picture is drawn in full.
inline constexpr double restAfter = 0.12;

/// Determines how small a picture must be to follow a drag, from the times of earlier pictures.
class Pace {
 public:
  /// Whether the whole picture is too slow to draw while something moves.
  bool tooSlow() const { return whole_ > slowFrame; }
  /// The look to draw while something moves: without anti-aliasing and, if necessary, at a
  /// resolution divided by a whole number.
  Look faster(const Look&) const;

  /// Like restAfter, but longer if a whole picture takes long, because it delays the next change
  /// once begun.
  double rest() const;

  /// Call when a different kind of scene is drawn while something moves: earlier times no longer
  /// apply.
  void learnAnew();

  /// Records the time of a whole picture; learning starts anew at rest. `cold`: it included
  /// compiling shaders, so the next ones are faster.
  void drewWhole(double ms, bool cold);
  /// Records the time of a picture by faster(); `cold` as above. If smaller pictures are hardly
  /// faster (limited by vertices, not pixels), the size is not reduced further.
  void drewFaster(double ms, bool cold = false);

  int division() const { return division_; }

 private:
  static constexpr int most = 6;
  double whole_ = 0;
  int division_ = 1;
  int useful_ = most;  ///< largest division worth trying
  double larger_ = 0;  ///< ms with one division less
  double least_ = 0;   ///< ms, the fastest of `tries_` with this division that were too slow
  int tries_ = 0;
  std::array<bool, most + 1> slow_{};  ///< divisions that were too slow since the last rest
};

}  // namespace glint::viewer
