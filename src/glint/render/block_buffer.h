#pragma once

#include <glad/gl.h>

#include <algorithm>
#include <vector>

#include "glint/gl/handles.h"

namespace glint {

/// Gives a uniform buffer these bytes.
inline void fill(const Buffer& buffer, std::size_t size, const void* from, GLenum usage) {
  glBindBuffer(GL_UNIFORM_BUFFER, buffer.id());
  glBufferData(GL_UNIFORM_BUFFER, GLsizeiptr(size), from, usage);
}

/// Packs blocks into one uniform buffer, each at an offset with the driver's alignment.
class BlockBuffer {
 public:
  BlockBuffer() {
    GLint alignment = 256;
    glGetIntegerv(GL_UNIFORM_BUFFER_OFFSET_ALIGNMENT, &alignment);
    step_ = std::size_t(std::max(alignment, 1));
  }
  /// The offset at which the next block begins.
  GLintptr begin() {
    bytes_.resize((bytes_.size() + step_ - 1) / step_ * step_);
    return GLintptr(bytes_.size());
  }
  template <typename Block>
  void add(const Block& block) {
    const auto* from = reinterpret_cast<const char*>(&block);
    bytes_.insert(bytes_.end(), from, from + sizeof block);
  }
  /// `room` bytes follow the last block, since a block that is not full is bound at its full
  /// length.
  void upload(const Buffer& buffer, std::size_t room = 0) {
    bytes_.resize(bytes_.size() + room);
    fill(buffer, bytes_.size(), bytes_.data(), GL_STREAM_DRAW);
  }

 private:
  std::size_t step_ = 1;
  std::vector<char> bytes_;
};

}  // namespace glint
