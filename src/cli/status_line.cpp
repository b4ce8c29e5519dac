#include "status_line.h"

#include <unistd.h>
#include <algorithm>

#include <iostream>

#include "glint/image/printable.h"
#include "glint/options/outputs.h"

namespace glint {

StatusLine::StatusLine() : terminal_(::isatty(STDERR_FILENO) != 0) {}

StatusLine::~StatusLine() { clear(); }

void StatusLine::clear() {
  if (shown_) std::cerr << "\r\033[K";
  shown_ = false;
}

void StatusLine::show(const std::string& text) {
  if (!terminal_) return;
  const std::lock_guard lock(mutex_);
  const auto now = Clock::now();
  if (now - start_ < std::chrono::seconds(1) || now - last_ < std::chrono::milliseconds(100))
    return;
  last_ = now;
  shown_ = true;
  std::cerr << "\r" << printable(text) << "\033[K" << std::flush;
}

void StatusLine::show(const std::string& task, double share, std::string_view what) {
  constexpr int width = 24;
  const double part = std::clamp(share, 0.0, 1.0);
  std::string bar(std::size_t(width), '.');
  std::fill_n(bar.begin(), int(part * width), '#');
  show(task + " [" + bar + "] " + std::to_string(int(100 * part)) + " % " + std::string(what));
}

void StatusLine::print(const std::string& line) {
  const std::lock_guard lock(mutex_);
  clear();
  std::cerr << printable(line) + "\n";
}

void StatusLine::printOut(const std::string& line) {
  const std::lock_guard lock(mutex_);
  clear();
  printWhole(line + "\n");
}

}  // namespace glint
