#pragma once

#include <optional>
#include <vector>

#include "glint/scene/look.h"

namespace glint::viewer {

enum class CompareMode { off, split, blink, difference };

/// What a person edits in the window, as a value: everything that undo brings back.
struct Document {
  Look a;                 ///< what is drawn; its resolution is that of the window, not this one
  std::optional<Look> b;  ///< the look kept for comparison
  CompareMode compare = CompareMode::off;
  bool exact = false;           ///< compares with the exact reference of A in place of B
  double divider = 0.5;         ///< of the split: share of the picture's width that shows A
  double amplification = 16.0;  ///< of the difference
  bool operator==(const Document&) const = default;
};

/// Whether the document compares A with the kept look, and there is one.
bool comparesLooks(const Document&);
/// Whether it compares A with its exact reference.
bool comparesExact(const Document&);

/// Undo and redo without limit. It is not told of edits: it sees them by comparison, so that none
/// can be forgotten, and takes all that happens in one gesture (a drag, a typed number) as one
/// step. While an animation plays, its time is no edit and stays as it is.
class History {
 public:
  explicit History(Document start = {}) : settled_(std::move(start)) {}

  /// To be called after every frame. While `gesture` is true nothing becomes a step yet.
  void settle(const Document& now, bool gesture, bool playing = false);

  std::size_t undoSteps() const { return undo_.size(); }

  /// Takes back the last step; an edit that is not settled yet is one. False if there is none.
  bool undo(Document& now, bool playing = false);
  bool redo(Document& now, bool playing = false);

 private:
  bool step(Document& now, bool playing, std::vector<Document>& from, std::vector<Document>& to);

  Document settled_;
  std::vector<Document> undo_, redo_;
};

/// The look without what only moves the camera, and without the resolution: what counts as an edit
/// when the window is closed.
Look withoutCamera(const Look&);

}  // namespace glint::viewer
