#pragma once

#include <optional>
#include <vector>

#include "glint/scene/look.h"

namespace glint::viewer {

enum class CompareMode { off, split, blink, difference };

/// The state that the user edits in the window, as a value: everything that undo restores.
struct Document {
  Look a;                 ///< what is drawn, but at the window's resolution instead of its own
  std::optional<Look> b;  ///< the look kept for comparison
  CompareMode compare = CompareMode::off;
  bool exact = false;           ///< compares with the exact reference of A instead of B
  double divider = 0.5;         ///< of the split: the fraction of the picture's width that shows A
  double amplification = 16.0;  ///< of the difference
  bool operator==(const Document&) const = default;
};

/// Whether the document compares A with B, and there is a B.
bool comparesLooks(const Document&);
/// Whether the document compares A with its exact reference.
bool comparesExact(const Document&);

/// Unlimited undo and redo. Edits are detected by comparison, so that none can be forgotten. All
/// changes during one gesture (a drag, a typed number) become one step. While an animation plays,
/// its time is neither an edit nor restored.
class History {
 public:
  explicit History(Document start = {}) : settled_(std::move(start)) {}

  /// Call this after every frame. While `gesture` is true, no step is recorded.
  void settle(const Document& now, bool gesture, bool playing = false);

  std::size_t undoSteps() const { return undo_.size(); }

  /// Undoes the last step, including edits not settled yet. False if there is none.
  bool undo(Document& now, bool playing = false);
  bool redo(Document& now, bool playing = false);

 private:
  bool step(Document& now, bool playing, std::vector<Document>& from, std::vector<Document>& to);

  Document settled_;
  std::vector<Document> undo_, redo_;
};

/// The look without the options that only move the camera and without the resolution: what counts
/// as an edit when the window is closed.
Look withoutCamera(const Look&);

}  // namespace glint::viewer
