#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "glint/image/image.h"
#include "session.h"
#include "worker.h"

namespace glint::viewer {

/// A picture by the reference renderer that grows from the top. Rows below `rows` are final and may
/// be read while the others are drawn.
struct ReferencePicture {
  Look look;     ///< as drawn: see exactLook
  Image linear;  ///< before exposure
  /// By pixel, 1 where an edge passes so close to a sample that a driver, which snaps vertices to a
  /// grid, may show what is on its other side: shading is not what differs there.
  std::vector<std::uint8_t> edges;
  std::atomic<int> rows = 0;
  std::string error;  ///< why there is none; set before `failed`
  std::atomic<bool> failed = false;

  bool done() const { return rows == linear.height && linear.height > 0; }
};

/// What a look is compared with: the same in the exact forms of lobe and reflectance. The look is
/// one that is drawn: where its program was chosen, the reference has that one.
Look exactLook(const Look&);

/// What the window draws while it compares with the reference: the reference has no multisampling,
/// so both do without.
Look comparableLook(const Look&);

/// Draws references in the background, one at a time: a new one takes the place of the last, which
/// is given up within a few rows.
class ReferenceTask {
 public:
  /// `progressed` is called from the thread that draws, not more often than ten times a second, and
  /// at the end.
  explicit ReferenceTask(std::function<void()> progressed = {});

  /// Starts drawing exactLook(look) unless that is what is drawn or being drawn.
  void want(std::shared_ptr<const Model> model, const Look& look);
  void stop();

  /// The picture wanted last; null if none.
  std::shared_ptr<const ReferencePicture> picture() const { return picture_; }

 private:
  std::function<void()> progressed_;
  std::shared_ptr<const Model> model_;
  std::shared_ptr<ReferencePicture> picture_;
  Worker worker_;
};

}  // namespace glint::viewer
