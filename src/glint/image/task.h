#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <future>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace glint {

// Threads for work that can do without them: where the system refuses more (a container's process
// limit), the waiting thread does the work.

/// Runs `work` in its own thread if one can be started, otherwise in the thread that asks for the
/// result.
template <typename Work>
auto startTask(Work work) -> std::future<decltype(work())> {
  try {
    return std::async(std::launch::async, work);
  } catch (const std::system_error&) {
    return std::async(std::launch::deferred, std::move(work));
  }
}

/// A thread that runs `work`, or an empty one (not joinable) if none can be started.
template <typename Work>
std::thread startThread(Work work) {
  try {
    return std::thread(std::move(work));
  } catch (const std::system_error&) {
    return {};
  }
}

/// Adds a thread to `workers`, which share the work; false if none can be started.
template <typename Workers, typename... Work>
bool addWorker(Workers& workers, Work&&... work) {
  try {
    workers.emplace_back(std::forward<Work>(work)...);
    return true;
  } catch (const std::system_error&) {
    return false;
  }
}

/// The number of threads requested, or the number of processors for 0.
inline int threadsFor(int asked) {
  return asked > 0 ? asked : std::max(1, int(std::thread::hardware_concurrency()));
}

/// Calls work(i, thread) once for each i below `count`, on up to threadsFor(threads) threads, each
/// of which takes its indices in ascending order. `thread` counts from 0, so that per-thread state
/// can be kept in a vector. The first exception is rethrown when all threads have ended; calls not
/// yet started are skipped.
template <typename Work>
void inParallel(int threads, std::size_t count, const Work& work) {
  std::atomic<std::size_t> next = 0;
  std::exception_ptr failure;
  std::mutex failing;
  const auto share = [&](int thread) {
    try {
      for (std::size_t i = next++; i < count; i = next++) work(i, thread);
    } catch (...) {
      next = count;
      const std::lock_guard lock(failing);
      if (!failure) failure = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> others;
    const int most = int(std::min(std::size_t(threadsFor(threads)), count));
    for (int t = 1; t < most && addWorker(others, share, t);) ++t;
    share(0);
  }
  if (failure) std::rethrow_exception(failure);
}

/// Calls work(begin, end) for consecutive ranges that cover 0 to count, on as many threads as there
/// are processors. Ranges are long enough that a small count starts no thread.
template <typename Work>
void inStretches(std::size_t count, const Work& work) {
  constexpr std::size_t length = std::size_t(1) << 16;
  inParallel(0, (count + length - 1) / length,
             [&](std::size_t i, int) { work(i * length, std::min(count, (i + 1) * length)); });
}

}  // namespace glint
