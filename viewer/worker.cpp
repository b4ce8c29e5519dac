#include "worker.h"

#include <sys/resource.h>

#include <utility>

namespace glint::viewer {

void stepBack(int steps) { setpriority(PRIO_PROCESS, 0, steps); }

Worker::Worker(std::function<void()> begin, std::function<void()> end)
    : thread_([this, begin = std::move(begin), end = std::move(end)] { run(begin, end); }) {}

Worker::~Worker() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
    latest_.reset();
    stop_ = true;
  }
  something_.notify_all();
  thread_.join();
}

void Worker::queue(Job job) {
  {
    const std::lock_guard lock(mutex_);
    queue_.push_back(std::move(job));
  }
  something_.notify_all();
}

void Worker::latest(Job job) {
  {
    const std::lock_guard lock(mutex_);
    latest_ = std::move(job);
    stop_ = true;
  }
  something_.notify_all();
}

void Worker::stopLatest() {
  const std::lock_guard lock(mutex_);
  latest_.reset();
  stop_ = true;
}

bool Worker::idle() const {
  const std::lock_guard lock(mutex_);
  return !busy_ && queue_.empty() && !latest_;
}

void Worker::run(const std::function<void()>& begin, const std::function<void()>& end) {
  if (begin) begin();
  static const std::atomic<bool> never = false;
  std::unique_lock lock(mutex_);
  while (true) {
    something_.wait(lock, [&] { return ending_ || latest_ || !queue_.empty(); });
    Job job;
    const std::atomic<bool>* stop = &never;
    if (!queue_.empty()) {
      job = std::move(queue_.front());
      queue_.pop_front();
    } else if (latest_) {
      job = *std::exchange(latest_, std::nullopt);
      stop_ = false;
      stop = &stop_;
    } else {
      break;
    }
    busy_ = true;
    lock.unlock();
    job(*stop);
    job = {};  // destroy what it holds on this thread
    lock.lock();
    busy_ = false;
  }
  lock.unlock();
  if (end) end();
}

}  // namespace glint::viewer
