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

// Threads for work that needs none: where the system gives no more (a container's limit of
// processes), the work is done by who waits for it.

/// The result of `work`, done in a thread of its own if there is one to be had, else by who asks
/// for the result.
template <typename Work>
auto startTask(Work work) -> std::future<decltype(work())> {
  try {
    return std::async(std::launch::async, work);
  } catch (const std::system_error&) {
    return std::async(std::launch::deferred, std::move(work));
  }
}

/// A thread that does `work`, or none (not joinable).
template <typename Work>
std::thread startThread(Work work) {
  try {
    return std::thread(std::move(work));
  } catch (const std::system_error&) {
    return {};
  }
}

/// Adds a thread to `workers`, which share out what there is to do; false if there is none.
template <typename Workers, typename... Work>
bool addWorker(Workers& workers, Work&&... work) {
  try {
    workers.emplace_back(std::forward<Work>(work)...);
    return true;
  } catch (const std::system_error&) {
    return false;
  }
}

/// As many threads as are asked for, or as there are processors for 0.
inline int threadsFor(int asked) {
  return asked > 0 ? asked : std::max(1, int(std::thread::hardware_concurrency()));
}

/// Calls work(i, thread) once for each i below `count`, in order on each of up to `threads` threads
/// (threadsFor()), which count from 0: what a thread keeps between calls may stand in a vector. The
/// first exception is thrown when all have ended; what has not begun by then is left out.
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

/// Calls work(begin, end) for stretches that make up 0 to count, on as many threads as there are
/// processors; a stretch is long enough that few elements start no thread.
template <typename Work>
void inStretches(std::size_t count, const Work& work) {
  constexpr std::size_t length = std::size_t(1) << 16;
  inParallel(0, (count + length - 1) / length,
             [&](std::size_t i, int) { work(i * length, std::min(count, (i + 1) * length)); });
}

}  // namespace glint
