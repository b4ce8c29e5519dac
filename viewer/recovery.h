#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "glint/scene/look.h"

namespace glint::viewer {

/// Edits that a window left behind when it ended without saving or discarding them.
struct Recovered {
  std::filesystem::path file;   ///< where they stand
  std::filesystem::path model;  ///< absolute; empty: no model was open
  Look look;
  std::filesystem::file_time_type time{};
};

/// Keeps unsaved edits on disk while a window is open, in a file of its own in a folder. Each file
/// has a lock beside it, which the system opens when the process ends in whatever way: what can be
/// locked was left behind. Errors are not told: nothing can be done about them, and the window goes
/// on without.
class Recovery {
 public:
  /// An empty folder: nothing is kept.
  explicit Recovery(std::filesystem::path folder);
  ~Recovery();
  Recovery(const Recovery&) = delete;
  Recovery& operator=(const Recovery&) = delete;

  /// To be called after every frame: writes the look if it is unsaved and has changed, not more
  /// often than every `leastSeconds`; removes the file when nothing is unsaved.
  void keep(const Look& look, bool unsaved, const std::filesystem::path& model);
  /// Whether keep() has something to write that waits for its time.
  bool waiting() const { return waiting_; }
  /// Removes the file: the window ends in good order.
  void clear();

  /// What others left behind, the newest first. Of a model if one is given.
  std::vector<Recovered> left(const std::filesystem::path& model = {}) const;
  /// Removes one of those, once it is restored or not wanted.
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
