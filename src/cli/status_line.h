#pragma once

#include <mutex>
#include <string>
#include <string_view>

#include "glint/image/clock.h"

namespace glint {

/// A progress line at the bottom of a terminal; does nothing if stderr is not a terminal. All other
/// output of the command meanwhile goes through it, so that lines do not mix. Thread-safe.
class StatusLine {
 public:
  StatusLine();
  ~StatusLine();
  StatusLine(const StatusLine&) = delete;
  StatusLine& operator=(const StatusLine&) = delete;

  /// Shows a text, unless one was shown a moment ago or the work began less than a second ago.
  void show(const std::string& text);
  /// Prints a bar with the share that is done, [0, 1], of a task, and what is being done.
  void show(const std::string& task, double share, std::string_view what);

  /// A line on stderr.
  void print(const std::string& line);
  /// Prints a line on stdout and flushes it. Throws InputError if it cannot be written.
  void printOut(const std::string& line);
  double seconds() const { return secondsSince(start_); }  ///< since the work began

 private:
  void clear();

  std::mutex mutex_;
  const bool terminal_;
  bool shown_ = false;
  const Clock::time_point start_ = Clock::now();
  Clock::time_point last_;
};

}  // namespace glint
