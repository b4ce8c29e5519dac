#pragma once

// Runs the glint binary as a user would: arguments, environment, output and exit status.

#include <fcntl.h>
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "files.h"

namespace glint::test {

using Json = nlohmann::json;
using Arguments = std::vector<std::string>;

/// The words of a command line, which blanks divide.
inline Arguments split(const std::string& line) {
  std::istringstream in(line);
  return {std::istream_iterator<std::string>(in), {}};
}

inline Arguments joined(Arguments first, const Arguments& more) {
  first.insert(first.end(), more.begin(), more.end());
  return first;
}

struct Ran {
  int status = -1;  ///< exit status; -1 if it did not exit by itself
  int signal = 0;   ///< that terminated it
  bool timedOut = false;
  long peakKib = 0;  ///< its peak memory
  std::string out, err;

  std::vector<std::string> errorLines() const { return linesOf(err); }
};

/// The binary takes this process's place.
[[noreturn]] inline void becomeGlint(const Arguments& arguments) {
  std::vector<char*> argv{const_cast<char*>(GLINT_EXECUTABLE)};
  for (const std::string& a : arguments) argv.push_back(const_cast<char*>(a.c_str()));
  argv.push_back(nullptr);
  execv(GLINT_EXECUTABLE, argv.data());
  _exit(127);
}

struct CommandOptions {
  std::vector<std::pair<std::string, std::string>> environment{};  ///< an empty value unsets
  int timeoutSeconds = 60;
  std::string folder{};    ///< working directory
  std::string input{};     ///< a file for its stdin; empty: an empty stdin
  bool closedOut = false;  ///< stdout is a pipe that nobody reads
  bool fullOut = false;    ///< stdout is a full disk
  long fileLimit = 0;      ///< limit for the size of a file that it writes, in bytes; 0: none
};

/// Runs the binary and waits for it.
inline Ran runGlint(const Arguments& arguments, const CommandOptions& options = {}) {
  static int number = 0;
  const std::string base = temporaryFolder() + "/run" + std::to_string(number++);
  const std::string outPath = base + ".out", errPath = base + ".err";
  const char* const outFile = options.fullOut ? "/dev/full" : outPath.c_str();
  int closed[2] = {-1, -1};
  if (options.closedOut) {
    EXPECT_EQ(pipe(closed), 0);
    close(closed[0]);
  }
  const pid_t child = fork();
  if (child == 0) {
    setpgid(0, 0);
    const int in = open(options.input.empty() ? "/dev/null" : options.input.c_str(), O_RDONLY);
    const int out =
        options.closedOut ? closed[1] : open(outFile, O_WRONLY | O_CREAT | O_TRUNC, 0600);
    const int err = open(errPath.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    dup2(in, 0);
    dup2(out, 1);
    dup2(err, 2);
    for (const auto& [name, value] : options.environment) {
      if (value.empty())
        unsetenv(name.c_str());
      else
        setenv(name.c_str(), value.c_str(), 1);
    }
    if (options.fileLimit > 0) {
      const rlimit limit{rlim_t(options.fileLimit), rlim_t(options.fileLimit)};
      setrlimit(RLIMIT_FSIZE, &limit);
    }
    if (!options.folder.empty() && chdir(options.folder.c_str()) != 0) _exit(126);
    becomeGlint(arguments);
  }
  if (options.closedOut) close(closed[1]);
  Ran ran;
  const auto deadline =
      std::chrono::steady_clock::now() + std::chrono::seconds(options.timeoutSeconds);
  int status = 0;
  rusage usage{};
  while (wait4(child, &status, WNOHANG, &usage) == 0) {
    if (std::chrono::steady_clock::now() > deadline && !ran.timedOut) {
      ran.timedOut = true;
      kill(child, SIGKILL);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  ran.peakKib = usage.ru_maxrss;
  if (WIFEXITED(status)) ran.status = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) ran.signal = WTERMSIG(status);
  ran.out = contents(outPath);
  ran.err = contents(errPath);
  std::filesystem::remove(outPath);
  std::filesystem::remove(errPath);
  return ran;
}

/// Runs a command line in a folder.
inline Ran runGlintIn(const Folder& folder, const std::string& line) {
  return runGlint(split(line), {.folder = folder.path()});
}

inline const std::string shipped = GLINT_SOURCE_DIR "/models/";

/// Arguments for a small picture that is drawn quickly.
inline Arguments quick(Arguments arguments, const Arguments& more = {}) {
  arguments = joined(std::move(arguments), more);
  if (std::find(arguments.begin(), arguments.end(), "--resolution") == arguments.end())
    arguments.insert(arguments.end(), {"--resolution", "40,30"});
  return joined(std::move(arguments), split("--rendering-backend osmesa --anti-aliasing none"));
}

/// It succeeded and printed nothing on stderr.
inline void expectDone(const Ran& ran) {
  EXPECT_EQ(ran.status, 0) << ran.err;
  EXPECT_EQ(ran.err, "");
}

/// It failed with one line that says what is wrong, and produced no output.
inline void expectRefusal(const Ran& ran, const std::string& part, int status = 2) {
  EXPECT_EQ(ran.status, status) << ran.err;
  EXPECT_EQ(ran.signal, 0);
  const auto lines = ran.errorLines();
  ASSERT_EQ(lines.size(), 1u) << ran.err;
  EXPECT_THAT(lines[0], testing::AllOf(testing::StartsWith("glint: "), testing::HasSubstr(part)));
  EXPECT_EQ(ran.out, "");
}

/// The report that it wrote to stdout before it ended well.
inline Json reportOf(const Ran& ran) {
  EXPECT_EQ(ran.status, 0) << ran.err;
  return Json::parse(ran.out);
}

inline std::vector<Json> jsonLines(const std::string& text) {
  std::vector<Json> lines;
  for (const std::string& line : linesOf(text)) lines.push_back(Json::parse(line));
  return lines;
}

}  // namespace glint::test
