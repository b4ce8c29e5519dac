#pragma once

#include <array>
#include <deque>

#include "window.h"

namespace glint::viewer {

/// ImGui set up for a window: font, colours, clipboard, and what it is told of input. Events come
/// from the window's queue, not from ImGui's own GLFW part, which loses what happens between two
/// frames.
class Interface {
 public:
  Interface(Window&, double scale);
  ~Interface();
  Interface(const Interface&) = delete;
  Interface& operator=(const Interface&) = delete;

  /// Hands events over to the next frame, but for keys that are not for widgets.
  void feed(const std::deque<InputEvent>& events);
  /// Begins a frame; `seconds` since the last one.
  void begin(double seconds);
  /// Ends a frame without drawing it, or draws it into the bound framebuffer.
  void end(bool draw);

 private:
  Window& window_;
  std::array<bool, 512> held_{};  ///< keys, by GLFW's codes
};

}  // namespace glint::viewer
