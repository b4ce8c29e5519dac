#pragma once

#include <glm/glm.hpp>
#include <string>

#include "input.h"

struct GLFWwindow;

namespace glint::viewer {

/// A window with an OpenGL 3.3 core context, current on this thread, and what happened in it.
class Window {
 public:
  /// `size` in window coordinates. Throws ContextError where there is no display or no context.
  Window(const std::string& title, glm::ivec2 size);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  glm::ivec2 size() const;             ///< window coordinates
  glm::ivec2 framebufferSize() const;  ///< pixels
  /// How much larger than usual text and widgets are to be, in window coordinates.
  double contentScale() const;
  /// At most as large as the screen.
  void resize(glm::ivec2 size);
  void setTitle(const std::string& title);
  void present();

  /// Waits for events, at most `seconds`; 0 does not wait. True if something happened, be it that
  /// wake() was called.
  bool wait(double seconds);
  /// Ends a wait; from any thread.
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

/// A context like a window's, of no use on the screen: for another thread to draw pictures with.
class OffscreenContext {
 public:
  /// On the main thread. Throws ContextError.
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
