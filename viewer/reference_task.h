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

/// A picture by the reference renderer, filled from the top. Rows below `rows` are final and may be
/// read while the others are being drawn.
struct ReferencePicture {
  Look look;     ///< as drawn: see exactLook
  Image linear;  ///< before exposure
  /// For each pixel, 1 where an edge passes so close to a sample that a driver, which snaps
  /// vertices to a grid, may show the other side: differences there are not due to shading.
  std::vector<std::uint8_t> edges;
  std::atomic<int> rows = 0;
  std::string error;  ///< the reason for a failure; set before `failed`
  std::atomic<bool> failed = false;

  bool done() const { return rows == linear.height && linear.height > 0; }
};

/// The reference look to compare with: the same look with the exact forms of lobe and reflectance.
/// The look must be one that is drawn: a program chosen for it is kept.
Look exactLook(const Look&);

/// The look that the window draws while comparing with the reference: the reference has no
/// multisampling, so neither uses it.
Look comparableLook(const Look&);

/// Draws references in the background, one at a time: a new one replaces the last, which is
/// cancelled within a few rows.
class ReferenceTask {
 public:
  /// `progressed` is called from the drawing thread, at most ten times a second, and at the end.
  explicit ReferenceTask(std::function<void()> progressed = {});

  /// Starts drawing exactLook(look) unless it is already drawn or being drawn.
  void want(std::shared_ptr<const Model> model, const Look& look);
  void stop();

  /// The picture requested last; null if none.
  std::shared_ptr<const ReferencePicture> picture() const { return picture_; }

 private:
  std::function<void()> progressed_;
  std::shared_ptr<const Model> model_;
  std::shared_ptr<ReferencePicture> picture_;
  Worker worker_;
};

}  // namespace glint::viewer
