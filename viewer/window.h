#pragma once

#include <glm/glm.hpp>
#include <string>

#include "input.h"

struct GLFWwindow;

namespace glint::viewer {

/// A window with an OpenGL 3.3 core context, current on this thread, and its input events.
class Window {
 public:
  /// `size` in window coordinates. Throws ContextError if there is no display or no context.
  Window(const std::string& title, glm::ivec2 size);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  glm::ivec2 size() const;             ///< window coordinates
  glm::ivec2 framebufferSize() const;  ///< pixels
  /// The scale for text and widgets, in window coordinates.
  double contentScale() const;
  /// Resizes, at most to the screen's size.
  void resize(glm::ivec2 size);
  void setTitle(const std::string& title);
  void present();

  /// Waits for events up to `seconds`; 0 does not wait. True if something happened, including
  /// wake().
  bool wait(double seconds);
  /// Ends a wait; callable from any thread.
  static void wake();

  bool closeRequested() const;
  void refuseClose();

  std::string clipboard() const;
  void setClipboard(const std::string& text);

  InputQueue& input() { return input_; }
  /// Called by the window system's callbacks.
  void happened() { happened_ = true; }
  GLFWwindow* handle() const { return window_; }

 private:
  GLFWwindow* window_ = nullptr;
  InputQueue input_;
  bool happened_ = true;
};

/// A context like a window's, but without output on the screen, so that another thread can draw.
class OffscreenContext {
 public:
  /// Call on the main thread. Throws ContextError.
  explicit OffscreenContext(const Window&);
  ~OffscreenContext();
  OffscreenContext(const OffscreenContext&) = delete;
  OffscreenContext& operator=(const OffscreenContext&) = delete;

  /// For the calling thread.
  void makeCurrent();
  void release();

 private:
  GLFWwindow* window_ = nullptr;
};

}  // namespace glint::viewer
