#pragma once

#include <glad/gl.h>

#include <cstddef>

#include "glint/gl/check.h"

namespace glint {

/// Limits how much work the driver has queued but not drawn. A software driver transforms triangles
/// faster than it fills them and stores the backlog: 400 MB for ten million with four samples. Must
/// be created and destroyed with the same context current.
class QueueLimit {
 public:
  QueueLimit() { requireContext("drawing"); }
  ~QueueLimit() { glDeleteSync(before_); }
  QueueLimit(const QueueLimit&) = delete;
  QueueLimit& operator=(const QueueLimit&) = delete;

  /// Indices that may be drawn before the next call of drawn(): whole triangles, never 0.
  std::size_t room() const { return most - queued_; }

  /// Counts indices that have been drawn. At the end of a batch, waits until the previous batch
  /// is drawn, so that the driver always has work.
  void drawn(std::size_t indices) {
    queued_ += (indices + 2) / 3 * 3;  // also for points and lines: room() stays whole triangles
    if (queued_ < most) return;
    queued_ = 0;
    const GLsync after = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    glFlush();
    if (before_) glClientWaitSync(before_, 0, second);
    glDeleteSync(before_);
    before_ = after;
  }

 private:
  static constexpr std::size_t most = 3 * 200'000;
  static constexpr GLuint64 second = 1'000'000'000;  // nothing breaks if it takes longer

  std::size_t queued_ = 0;
  GLsync before_ = nullptr;
};

}  // namespace glint
