#pragma once

#include <chrono>
#include <string>
#include <string_view>

namespace glint {

/// A bar on stderr that says how far long work is: only where stderr is a terminal, and only of
/// work that takes more than a second. Gone when it is destroyed.
class Progress {
 public:
  /// `task` begins the line.
  explicit Progress(std::string task);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// The share that is done, [0, 1], and what is being done, if there is more than one thing.
  void show(double share, std::string_view what = {});

 private:
  std::string task_;
  bool terminal_, shown_ = false;
  std::chrono::steady_clock::time_point start_, last_;
};

}  // namespace glint
