#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "glint/scene/look.h"

namespace glint::viewer {

/// Edits left behind by a window that ended without saving or discarding them.
struct Recovered {
  std::filesystem::path file;   ///< where they are stored
  std::filesystem::path model;  ///< absolute; empty: no model was open
  Look look;
  std::filesystem::file_time_type time{};
};

/// Keeps unsaved edits on disk while a window is open, in a file of its own in a folder. Each file
/// has a lock next to it, which the system releases when the process ends in any way; so a file
/// whose lock can be taken was left behind. Errors are not reported: nothing can be done about
/// them, and the window works without recovery.
class Recovery {
 public:
  /// With an empty folder, nothing is kept.
  explicit Recovery(std::filesystem::path folder);
  ~Recovery();
  Recovery(const Recovery&) = delete;
  Recovery& operator=(const Recovery&) = delete;

  /// Call this after every frame: writes the look if it is unsaved and has changed, at most every
  /// `leastSeconds`; removes the file when nothing is unsaved.
  void keep(const Look& look, bool unsaved, const std::filesystem::path& model);
  /// Whether keep() is delaying a write.
  bool waiting() const { return waiting_; }
  /// Removes the file, for a normal exit.
  void clear();

  /// What other windows left behind, newest first; only for `model` if one is given.
  std::vector<Recovered> left(const std::filesystem::path& model = {}) const;
  /// Removes one of those, after it has been restored or declined.
  static void discard(const Recovered&);

  static constexpr double leastSeconds = 0.5;

 private:
  void lock();

  std::filesystem::path folder_, file_;
  int lock_ = -1;
  bool written_ = false, waiting_ = false;
  Look last_;
  std::chrono::steady_clock::time_point lastTime_{};
};

}  // namespace glint::viewer
