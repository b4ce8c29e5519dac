#include "interrupt.h"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>

namespace glint {
namespace {

std::atomic<int> came = 0;
int ends[2] = {-1, -1};
struct sigaction before[2];
constexpr int watched[2] = {SIGINT, SIGTERM};

void note(int number) {
  const int error = errno;
  came = number;
  const char byte = 0;
  [[maybe_unused]] const ssize_t written = ::write(ends[1], &byte, 1);
  errno = error;
}

}  // namespace

Interrupt::Interrupt() {
  if (::pipe2(ends, O_CLOEXEC | O_NONBLOCK) != 0) ends[0] = ends[1] = -1;
  for (int i = 0; i < 2; ++i) {
    ::sigaction(watched[i], nullptr, &before[i]);
    if (before[i].sa_handler == SIG_IGN) continue;
    struct sigaction action {};
    action.sa_handler = note;
    action.sa_flags = SA_RESETHAND | SA_RESTART;
    ::sigaction(watched[i], &action, nullptr);
  }
}

Interrupt::~Interrupt() {
  for (int i = 0; i < 2; ++i) ::sigaction(watched[i], &before[i], nullptr);
  for (int& end : ends) {
    if (end >= 0) ::close(end);
    end = -1;
  }
  came = 0;
}

int Interrupt::signal() { return came; }

int Interrupt::descriptor() { return ends[0]; }

}  // namespace glint
