#pragma once

#include "glint/scene/look.h"

namespace glint::viewer {

/// How long a picture may take that follows a hand, ms.
inline constexpr double slowFrame = 1000.0 / 30;

/// How small a picture has to be to follow a hand: learnt from the times that pictures took.
class Pace {
 public:
  /// Whether the whole picture is too slow to be drawn while something moves.
  bool tooSlow() const { return whole_ > slowFrame; }
  /// What is drawn while something moves: without anti-aliasing, and if need be smaller, by a whole
  /// number.
  Look faster(const Look&) const;

  /// A whole picture took so long. `cold`: shaders were compiled for it, the next ones are faster.
  void drewWhole(double ms, bool cold);
  /// A picture by faster() took so long; `cold` as above. Where smaller ones are hardly faster
  /// (vertices take the time, not pixels) they are not made smaller still.
  void drewFaster(double ms, bool cold = false);

  int division() const { return division_; }

 private:
  static constexpr int most = 6;
  double whole_ = 0;
  int division_ = 1;
  int useful_ = most;  ///< smaller pictures were no faster
  double larger_ = 0;  ///< ms by one division less
};

}  // namespace glint::viewer
