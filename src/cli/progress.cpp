#include "progress.h"

#include <unistd.h>

#include <algorithm>
#include <iostream>

#include "glint/image/printable.h"

namespace glint {

using namespace std::chrono_literals;

Progress::Progress(std::string task)
    : task_(std::move(task)),
      terminal_(isatty(STDERR_FILENO) != 0),
      start_(std::chrono::steady_clock::now()) {}

Progress::~Progress() {
  if (shown_) std::cerr << "\r\033[K";
}

void Progress::show(double share, std::string_view what) {
  const auto now = std::chrono::steady_clock::now();
  if (!terminal_ || now - start_ < 1s || (shown_ && now - last_ < 50ms)) return;
  shown_ = true;
  last_ = now;
  constexpr int width = 24;
  const double part = std::clamp(share, 0.0, 1.0);
  const int full = int(part * width);
  std::cerr << "\r" << task_ << " [" << std::string(std::size_t(full), '#')
            << std::string(std::size_t(width - full), '.') << "] " << int(100 * part) << " % "
            << printable(what) << "\033[K" << std::flush;
}

}  // namespace glint
