#pragma once

#include <cstddef>
#include <deque>
#include <string>

struct GLFWwindow;

namespace glint::viewer {

/// One input action of the user.
struct InputEvent {
  enum class Kind { motion, button, scroll, key, character, drop, focus };
  Kind kind = Kind::motion;
  double x = 0, y = 0;    ///< motion: window coordinates; scroll: offsets
  int code = 0;           ///< button, key (GLFW's) or Unicode character
  bool down = false;      ///< button, key; focus: gained
  bool repeated = false;  ///< key
  int modifiers = 0;      ///< GLFW's
  std::string path;       ///< drop
  /// key: goes to a widget, not to the table of actions; see App::isForWidgets.
  bool forWidgets = true;
  bool presses = false;  ///< key: Enter, where it acts as Space
};

/// Events from the window system, in order. ImGui 1.86 has no event queue: a press and its release
/// within one frame would be lost. Here, a frame gets events only up to the first one that would
/// hide another (take()).
class InputQueue {
 public:
  /// Appends an event; a motion directly after another replaces it.
  void add(InputEvent event);
  bool empty() const { return events_.empty(); }

  /// Removes and returns the events of the next frame: motions up to a button, key or scroll event,
  /// and then one such event, or a run of characters.
  std::deque<InputEvent> take();

 private:
  std::deque<InputEvent> events_;
};

}  // namespace glint::viewer
