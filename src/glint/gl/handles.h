#pragma once

#include <glad/gl.h>

#include <utility>

#include "glint/gl/check.h"

namespace glint {

/// Owns the name of a GL object. Move-only; 0 is empty. It must be destroyed while the context in
/// which it was created is current; an empty one may be destroyed at any time. glDelete* is called
/// only in this file. Kind has static GLuint make(...) and static void destroy(GLuint).
template <class Kind>
class Handle {
 public:
  Handle() = default;
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
  Handle& operator=(Handle&& other) noexcept {
    Handle old(std::move(*this));
    id_ = std::exchange(other.id_, 0);
    return *this;
  }
  ~Handle() {
    if (id_) Kind::destroy(id_);
  }

  /// Creates a GL object; shaders take their stage. Throws Error if no context is current.
  template <class... Arguments>
  static Handle make(Arguments... arguments) {
    requireContext("making a GL object");
    Handle handle;
    handle.id_ = Kind::make(arguments...);
    return handle;
  }

  GLuint id() const { return id_; }
  explicit operator bool() const { return id_ != 0; }

 private:
  GLuint id_ = 0;
};

/// Objects that are created and deleted in arrays. The functions are pointers that change with the
/// context, hence their addresses.
template <auto* generate, auto* remove>
struct ArrayKind {
  static GLuint make() {
    GLuint id = 0;
    (*generate)(1, &id);
    return id;
  }
  static void destroy(GLuint id) { (*remove)(1, &id); }
};

struct ShaderKind {
  static GLuint make(GLenum stage) { return glCreateShader(stage); }
  static void destroy(GLuint id) { glDeleteShader(id); }
};

struct ProgramKind {
  static GLuint make() { return glCreateProgram(); }
  static void destroy(GLuint id) { glDeleteProgram(id); }
};

using Buffer = Handle<ArrayKind<&glGenBuffers, &glDeleteBuffers>>;
using VertexArray = Handle<ArrayKind<&glGenVertexArrays, &glDeleteVertexArrays>>;
using TextureHandle = Handle<ArrayKind<&glGenTextures, &glDeleteTextures>>;
using Framebuffer = Handle<ArrayKind<&glGenFramebuffers, &glDeleteFramebuffers>>;
using Renderbuffer = Handle<ArrayKind<&glGenRenderbuffers, &glDeleteRenderbuffers>>;
using Query = Handle<ArrayKind<&glGenQueries, &glDeleteQueries>>;
using ShaderHandle = Handle<ShaderKind>;
using ProgramHandle = Handle<ProgramKind>;

}  // namespace glint
