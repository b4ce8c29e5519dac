#include "glint/options/outputs.h"

#include <cerrno>
#include <filesystem>
#include <iostream>
#include <span>
#include <system_error>

#include "glint/image/error.h"
#include "glint/image/file.h"

namespace fs = std::filesystem;

namespace glint {

bool isSameFile(const std::string& a, const std::string& b) {
  std::error_code error;
  if (fs::equivalent(a, b, error)) return true;
  const fs::path first = fs::absolute(a, error).lexically_normal();
  return first == fs::absolute(b, error).lexically_normal();
}

void checkOutputs(std::initializer_list<OutputOption> outputs,
                  const std::vector<std::string>& inputs) {
  for (const OutputOption& output : outputs) {
    if (output.path.empty()) continue;
    const std::string what = output.option + " " + printablePath(output.path) + ": ";
    for (const OutputOption* other = outputs.begin(); other != &output; ++other) {
      if (other->path.empty()) continue;
      if (output.path == "-" && other->path == "-")
        throw InputError(what + other->option + " goes to stdout already: give one of them a file");
      // Devices, /dev/null above all, may be given twice.
      std::error_code ignored;
      if (fs::exists(output.path, ignored) && !fs::is_regular_file(output.path, ignored)) continue;
      if (output.path != "-" && isSameFile(output.path, other->path))
        throw InputError(what + other->option + " writes that file already: give another");
    }
    if (output.path == "-") continue;
    for (const std::string& input : inputs)
      if (!input.empty() && isSameFile(output.path, input))
        throw InputError(what + "would overwrite what is read: give another file");
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
  const int error = errno;
  throw InputError("standard output: " +
                   (error != 0 ? std::generic_category().message(error) : "cannot be written") +
                   ": free some space or write elsewhere");
}

void writeText(const std::string& path, const std::string& text) {
  OutputFile file(path);
  file.write(std::as_bytes(std::span(text)));
  file.commit();
}

void printWarning(const std::string& text) {
  std::cerr << "glint: warning: " << printablePath(text) << "\n";
}

}  // namespace glint
