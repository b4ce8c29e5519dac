#pragma once

#include <array>
#include <deque>

#include "window.h"

namespace glint::viewer {

/// Sets up ImGui for a window: font, colours, clipboard and input. Events come from the window's
/// queue, not from ImGui's GLFW backend, which loses what happens between two frames.
class Interface {
 public:
  Interface(Window&, double scale);
  ~Interface();
  Interface(const Interface&) = delete;
  Interface& operator=(const Interface&) = delete;

  /// Passes events to the next frame, except for keys that are not for widgets.
  void feed(const std::deque<InputEvent>& events);
  /// Begins a frame, `seconds` after the last one.
  void begin(double seconds);
  /// Ends a frame without drawing it, or draws it into the bound framebuffer.
  void end(bool draw);

 private:
  Window& window_;
  std::array<bool, 512> held_{};  ///< keys, by GLFW code
};

}  // namespace glint::viewer
