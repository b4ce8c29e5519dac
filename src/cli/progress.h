#pragma once

#include <chrono>
#include <string>
#include <string_view>

namespace glint {

/// A progress bar on stderr, only if stderr is a terminal and the work takes more than a second. It
/// is erased on destruction.
class Progress {
 public:
  /// `task` begins the line.
  explicit Progress(std::string task);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// The fraction done, [0, 1], and the current item, if there is more than one.
  void show(double share, std::string_view what = {});

 private:
  std::string task_;
  bool terminal_, shown_ = false;
  std::chrono::steady_clock::time_point start_, last_;
};

}  // namespace glint
