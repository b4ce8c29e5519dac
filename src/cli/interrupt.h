#pragma once

namespace glint {

/// While it lives, SIGINT and SIGTERM end the work in hand instead of the process: the work stops
/// at the next safe point, complete files stay, and nothing half-written is left. A second signal
/// ends the process at once. A signal that was ignored before (nohup) stays ignored.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  /// The signal received, or 0. May be called from any thread.
  static int signal();
  /// A descriptor for poll() that becomes readable once a signal has been received.
  static int descriptor();
};

}  // namespace glint
