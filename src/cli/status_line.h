#pragma once

#include <chrono>
#include <mutex>
#include <string>

namespace glint {

/// A line at the bottom of a terminal that says how far the work is; nothing if stderr is none.
/// All that a command writes meanwhile goes through it, so that lines do not mix. Safe to use from
/// several threads.
class StatusLine {
 public:
  StatusLine();
  ~StatusLine();
  StatusLine(const StatusLine&) = delete;
  StatusLine& operator=(const StatusLine&) = delete;

  /// Shows a text, unless the last one was shown a moment ago or the work began within a second.
  void show(const std::string& text);
  /// A line on stderr.
  void print(const std::string& line);
  /// A line on stdout, at once. Throws InputError if it cannot be written.
  void printOut(const std::string& line);
  double seconds() const;  ///< since the work began

 private:
  using Clock = std::chrono::steady_clock;
  void clear();

  std::mutex mutex_;
  const bool terminal_;
  bool shown_ = false;
  const Clock::time_point start_ = Clock::now();
  Clock::time_point last_;
};

}  // namespace glint
