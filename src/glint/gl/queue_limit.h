#pragma once

#include <glad/gl.h>

#include <cstddef>

#include "glint/gl/check.h"

namespace glint {

/// Keeps short what the driver has taken and not drawn yet. A software driver transforms triangles
/// faster than it fills them and keeps the difference: of ten million with four samples, 400 MB.
/// Lives and dies in one current context.
class QueueLimit {
 public:
  QueueLimit() { requireContext("drawing"); }
  ~QueueLimit() { glDeleteSync(before_); }
  QueueLimit(const QueueLimit&) = delete;
  QueueLimit& operator=(const QueueLimit&) = delete;

  /// Indices that may be drawn before drawn() is called next: of whole triangles, not 0.
  std::size_t room() const { return most - queued_; }

  /// So many indices were drawn. Waits, where it was the last of a portion, until the portion
  /// before is drawn, so that there is always work.
  void drawn(std::size_t indices) {
    queued_ += (indices + 2) / 3 * 3;  // of points and lines too: what is left is whole triangles
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
  static constexpr GLuint64 second = 1'000'000'000;  // nothing breaks where it takes longer

  std::size_t queued_ = 0;
  GLsync before_ = nullptr;
};

}  // namespace glint
