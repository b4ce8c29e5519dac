#include "stdin_model.h"

#include <poll.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <string_view>
#include <system_error>
#include <vector>

#include "glint/gltf/file.h"
#include "interrupt.h"

namespace glint {
namespace {

[[noreturn]] void fail(const std::string& advice) {
  throw InputError("stdin: " + std::generic_category().message(errno) + ": " + advice);
}

void writeAll(int file, const char* from, std::size_t count) {
  while (count > 0) {
    const ssize_t written = ::write(file, from, count);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) fail("give the model as a file");
    from += written;
    count -= static_cast<std::size_t>(written);
  }
}

// Waits until stdin has bytes or has ended; a signal ends the wait. Sets errno where it fails.
bool waitForStdin() {
  pollfd ready[2] = {{STDIN_FILENO, POLLIN, 0}, {Interrupt::descriptor(), POLLIN, 0}};
  while (Interrupt::signal() == 0) {
    if (::poll(ready, 2, -1) < 0 && errno != EINTR) return false;
    if (ready[0].revents != 0) return true;
  }
  errno = EINTR;
  return false;
}

// A file without a name, which lasts until the process ends: readers open it more than once.
std::string spooled() {
  const int file = ::memfd_create("stdin", MFD_CLOEXEC);
  if (file < 0) fail("give the model as a file");
  std::vector<char> piece(std::size_t(1) << 16);
  for (std::uint64_t size = 0;;) {
    const ssize_t got = waitForStdin() ? ::read(STDIN_FILENO, piece.data(), piece.size()) : -1;
    if (got < 0 && (errno == EAGAIN || errno == EINTR) && Interrupt::signal() == 0) continue;
    if (got < 0) fail("give a model, as in glint render - -o OUT < MODEL");
    if (got == 0) break;
    size += static_cast<std::uint64_t>(got);
    if (size > std::uint64_t(1) << 32)
      throw InputError("stdin: more than 4 GiB: give the model as a file");
    writeAll(file, piece.data(), static_cast<std::size_t>(got));
  }
  return "/proc/self/fd/" + std::to_string(file);
}

// Read when first needed; if that fails, it fails again each time.
const std::string& spoolPath() {
  static const std::string path = spooled();
  return path;
}

}  // namespace

std::string localPath(const std::string& model) {
  constexpr std::string_view scheme = "file://", here = "localhost";
  if (!model.starts_with(scheme)) return model;
  std::string_view rest = std::string_view(model).substr(scheme.size());
  if (rest.starts_with(here)) rest.remove_prefix(here.size());
  return rest.starts_with('/') ? gltf::percentDecoded(rest) : model;
}

bool isStdin(const std::string& model) { return model == "-" || model == "/dev/stdin"; }

std::string modelFile(const std::string& model) { return isStdin(model) ? spoolPath() : model; }

std::string withoutModelFile(std::string text) {
  const std::string& path = spoolPath();
  for (auto at = text.find(path); at != std::string::npos; at = text.find(path, at + 5))
    text.replace(at, path.size(), "stdin");
  return text;
}

}  // namespace glint
