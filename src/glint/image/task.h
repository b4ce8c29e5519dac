#pragma once

#include <future>
#include <system_error>
#include <thread>
#include <utility>

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

}  // namespace glint
