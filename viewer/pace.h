#pragma once

#include <array>

#include "glint/scene/look.h"

namespace glint::viewer {

/// How long a picture may take that follows a hand, ms.
inline constexpr double slowFrame = 1000.0 / 30;

/// Seconds without a change after which the picture is drawn in full.
inline constexpr double restAfter = 0.12;

/// How small a picture has to be to follow a hand: learnt from the times that pictures took.
class Pace {
 public:
  /// Whether the whole picture is too slow to be drawn while something moves.
  bool tooSlow() const { return whole_ > slowFrame; }
  /// What is drawn while something moves: without anti-aliasing, and if need be smaller, by a whole
  /// number.
  Look faster(const Look&) const;

  /// As restAfter, but longer where a whole picture takes long: once begun it holds up the next
  /// change.
  double rest() const;

  /// What is drawn while something moves is of another kind now: former times mean nothing any
  /// more.
  void learnAnew();

  /// A whole picture took so long; at rest sizes are learnt anew. `cold`: shaders were compiled for
  /// it, the next ones are faster.
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
  double least_ = 0;   ///< ms by this one, of `tries_` that were too slow
  int tries_ = 0;
  std::array<bool, most + 1> slow_{};  ///< divisions that were too slow since the last rest
};

}  // namespace glint::viewer
