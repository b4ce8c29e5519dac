#pragma once

#include <chrono>

namespace glint {

using Clock = std::chrono::steady_clock;

/// Milliseconds from `start` to now.
inline double since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// The same in seconds.
inline double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace glint
