#pragma once

#include <unistd.h>

#include <cstdio>
#include <string>
#include <thread>
#include <vector>

#include "glint/glint.h"

namespace glint::test {

/// The resident memory of this process in bytes.
inline double residentBytes() {
  long pages = 0, resident = 0;
  if (std::FILE* const file = std::fopen("/proc/self/statm", "r")) {
    if (std::fscanf(file, "%ld %ld", &pages, &resident) != 2) resident = 0;
    std::fclose(file);
  }
  return double(resident) * double(sysconf(_SC_PAGESIZE));
}

/// Draws one picture in each of `count` sessions, each with its own model, on `threads` threads.
inline void drawSessions(int count, int threads, const std::string& model) {
  std::vector<std::thread> workers;
  for (int i = 0; i < threads; ++i)
    workers.emplace_back([&, i] {
      for (int k = i; k < count; k += threads) {
        Session session("osmesa");
        (void)session.draw(Model::load(model), {{"resolution", "32,32"}});
      }
    });
  for (std::thread& each : workers) each.join();
}

}  // namespace glint::test
