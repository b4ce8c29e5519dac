#pragma once

#include <cstddef>
#include <deque>
#include <string>

struct GLFWwindow;

namespace glint::viewer {

/// One thing that the person at the window did.
struct InputEvent {
  enum class Kind { motion, button, scroll, key, character, drop, focus };
  Kind kind = Kind::motion;
  double x = 0, y = 0;    ///< motion: window coordinates; scroll: offsets
  int code = 0;           ///< button, key (GLFW's) or Unicode character
  bool down = false;      ///< button, key; focus: gained
  bool repeated = false;  ///< key
  int modifiers = 0;      ///< GLFW's
  std::string path;       ///< drop
  /// key: a widget takes it, not the table of actions; see App::isForWidgets.
  bool forWidgets = true;
  bool presses = false;  ///< key: Enter, where it does what Space does
};

/// What the window system reported, in order. ImGui 1.86 has no queue of its own: given all at
/// once, a press and its release between two frames are lost. Here every frame gets events only up
/// to the one that would hide another (take()).
class InputQueue {
 public:
  /// Appends; a motion that follows a motion replaces it.
  void add(InputEvent event);
  bool empty() const { return events_.empty(); }

  /// Removes and returns the events of the next frame: motions up to a button, key or scroll event,
  /// and of those one, or a run of characters.
  std::deque<InputEvent> take();

 private:
  std::deque<InputEvent> events_;
};

}  // namespace glint::viewer
