#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

namespace glint::viewer {

/// A thread that does what takes longer than a frame. Two kinds of jobs: those that are all done,
/// in order (queue), and those of which only the newest counts (latest). A job must not throw.
class Worker {
 public:
  /// `stop` becomes true when the job's result is no longer wanted.
  using Job = std::function<void(const std::atomic<bool>& stop)>;

  /// `begin` and `end` run on the thread, first and last.
  explicit Worker(std::function<void()> begin = {}, std::function<void()> end = {});
  /// Does what is queued, drops the latest, waits for the thread to end.
  ~Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  /// Queued jobs run before the latest; they are not stopped.
  void queue(Job job);
  /// Takes the place of the latest job that has not begun, and stops one that has.
  void latest(Job job);
  /// Drops the latest job, or stops it.
  void stopLatest();

  bool idle() const;

 private:
  void run(const std::function<void()>& begin, const std::function<void()>& end);

  mutable std::mutex mutex_;
  std::condition_variable something_;
  std::deque<Job> queue_;
  std::optional<Job> latest_;
  std::atomic<bool> stop_ = false;  ///< for the latest job that runs
  bool ending_ = false, busy_ = false;
  std::thread thread_;
};

/// For a thread whose work can wait, and those that it starts: the window comes first, by so many
/// steps of the system's priorities.
void stepBack(int steps);

}  // namespace glint::viewer
