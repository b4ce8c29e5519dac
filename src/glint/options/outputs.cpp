#include "glint/options/outputs.h"

#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <iostream>
#include <span>
#include <system_error>

#include "glint/gltf/model_files.h"
#include "glint/image/error.h"
#include "glint/image/file.h"
#include "glint/image/read_files.h"

namespace fs = std::filesystem;

namespace glint {

bool isSameFile(const std::string& a, const std::string& b) {
  std::error_code error;
  if (fs::equivalent(a, b, error)) return true;
  const fs::path first = fs::absolute(a, error).lexically_normal();
  return first == fs::absolute(b, error).lexically_normal();
}

void checkOutputs(const std::vector<OutputOption>& outputs,
                  const std::vector<std::string>& inputs) {
  // A file that does not exist yet cannot be lost.
  const bool replaces = std::ranges::any_of(
      outputs, [](const OutputOption& output) { return !isMissing(output.path); });
  for (const std::string& input : inputs) {
    if (input.empty()) continue;
    noteReadFile(input);
    if (replaces) noteModelFiles(input);
  }
  for (const OutputOption& output : outputs) {
    if (output.path.empty()) continue;
    const std::string what = output.option + " " + printablePath(output.path) + ": ";
    for (const OutputOption* other = outputs.data(); other != &output; ++other) {
      if (other->path.empty()) continue;
      if (output.path == "-" && other->path == "-")
        throw InputError(what + other->option + " already goes to stdout: give one of them a file");
      // Devices, above all /dev/null, may be given twice.
      std::error_code ignored;
      if (!isMissing(output.path) && !fs::is_regular_file(output.path, ignored)) continue;
      if (output.path != "-" && isSameFile(output.path, other->path))
        throw InputError(what + other->option + " already writes to that file: give another");
    }
    if (output.path == "-") continue;
    bool isInput = isReadFile(output.path);
    for (const std::string& input : inputs)
      isInput = isInput || (!input.empty() && isSameFile(output.path, input));
    if (isInput) throw InputError(what + "would overwrite an input file: give another file");
  }
}

OutputFolder::OutputFolder(const std::string& path) {
  if (const std::error_code error = folders_.make(path))
    throw InputError("--output " + printablePath(path) + ": cannot make this folder: " +
                     error.message() + ": give one that can be written");
}

void flushStandardOutput() {
  errno = 0;
  std::cout.flush();
  if (std::cout) return;
  throw InputError("standard output: " + writeFailure(errno != 0 ? errno : EIO));
}

void printWhole(const std::string& text) {
  flushStandardOutput();
  struct stat before {};
  const bool isFile = ::fstat(STDOUT_FILENO, &before) == 0 && S_ISREG(before.st_mode);
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t count = ::write(STDOUT_FILENO, text.data() + done, text.size() - done);
    if (count > 0) done += std::size_t(count);
    if (count > 0 || (count < 0 && errno == EINTR)) continue;
    const int error = errno;
    if (error == EAGAIN) {  // a non-blocking pipe
      pollfd ready{STDOUT_FILENO, POLLOUT, 0};
      ::poll(&ready, 1, -1);
      continue;
    }
    // In a file, takes back the part that was written, unless another process writes there too.
    struct stat after {};
    if (isFile && done > 0 && ::fstat(STDOUT_FILENO, &after) == 0 &&
        after.st_size == before.st_size + off_t(done) &&
        ::ftruncate(STDOUT_FILENO, before.st_size) == 0)
      ::lseek(STDOUT_FILENO, before.st_size, SEEK_SET);
    throw InputError("standard output: " + writeFailure(error));
  }
}

void commitText(OutputFile& file, std::string_view text) {
  file.write(text);
  file.commit();
}

void writeText(const std::string& path, const std::string& text) {
  OutputFile file(path);
  commitText(file, text);
}

void printWarning(const std::string& text) {
  std::cerr << "glint: warning: " << printablePath(text) << "\n";
}

}  // namespace glint
