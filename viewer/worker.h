#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

namespace glint::viewer {

/// A thread for work that takes longer than a frame. There are two kinds of jobs: queued ones,
/// which are all run, in order, and latest ones, of which only the newest counts. A job must not
/// throw.
class Worker {
 public:
  /// `stop` becomes true when the job's result is no longer wanted.
  using Job = std::function<void(const std::atomic<bool>& stop)>;

  /// `begin` and `end` run on the thread, first and last.
  explicit Worker(std::function<void()> begin = {}, std::function<void()> end = {});
  /// Runs the queued jobs, drops the latest one and joins the thread.
  ~Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  /// Queued jobs run before the latest one and are not stopped.
  void queue(Job job);
  /// Replaces a latest job that has not begun, and stops one that has.
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
  std::atomic<bool> stop_ = false;  ///< for the latest job while it runs
  bool ending_ = false, busy_ = false;
  std::thread thread_;
};

/// Lowers the priority of the calling thread, and of threads that it starts, by this many steps of
/// the system's scale, so that the window comes first.
void stepBack(int steps);

}  // namespace glint::viewer
