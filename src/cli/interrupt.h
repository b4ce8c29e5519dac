#pragma once

namespace glint {

/// While it lives, SIGINT and SIGTERM end the work in hand instead of the process: what is being
/// done stops at the next good place, files that are whole stay, nothing half-written is left. A
/// second one ends the process at once. A signal that was ignored before (nohup) stays so.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  /// The signal that has come, or 0. May be asked from every thread.
  static int signal();
  /// Readable once a signal has come, for poll().
  static int descriptor();
};

}  // namespace glint
