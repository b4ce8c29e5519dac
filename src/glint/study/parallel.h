#pragma once

#include <algorithm>
#include <cstddef>
#include <thread>
#include <vector>

#include "glint/image/task.h"

namespace glint {

/// Calls work(begin, end) for parts of [0, count), on all cores. `work` must not throw.
template <class Work>
void inParts(std::size_t count, const Work& work) {
  const std::size_t parts = std::clamp<std::size_t>(std::thread::hardware_concurrency(), 1,
                                                    std::max<std::size_t>(1, count));
  std::vector<std::jthread> others;
  for (std::size_t i = 1; i < parts; ++i) {
    const auto part = [&, i] { work(count * i / parts, count * (i + 1) / parts); };
    if (!addWorker(others, part)) part();
  }
  work(0, count / parts);
}

}  // namespace glint
