#pragma once

// The glint binary with a pipe at each end, to talk with while it runs.

#include <poll.h>

#include "command.h"

namespace glint::test {

/// The binary with pipes for stdin and stdout.
class Running {
 public:
  explicit Running(const Arguments& arguments) {
    int in[2], out[2];
    EXPECT_EQ(pipe2(in, O_CLOEXEC), 0);
    EXPECT_EQ(pipe2(out, O_CLOEXEC), 0);
    child_ = fork();
    if (child_ == 0) {
      dup2(in[0], 0);
      dup2(out[1], 1);
      dup2(open(errPath_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), 2);
      becomeGlint(arguments);
    }
    close(in[0]);
    close(out[1]);
    in_ = in[1];
    out_ = out[0];
  }
  ~Running() {
    if (child_ > 0) {
      kill(child_, SIGKILL);
      waitpid(child_, nullptr, 0);
    }
    closeIn();
    close(out_);
  }
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;

  void write(const std::string& text) {
    EXPECT_EQ(::write(in_, text.data(), text.size()), ssize_t(text.size()));
  }
  void closeIn() {
    if (in_ >= 0) close(in_);
    in_ = -1;
  }
  void signal(int number) { kill(child_, number); }

  /// The next line of its output; empty at the end or on a timeout.
  std::string line() {
    for (;;) {
      const auto end = text_.find('\n');
      if (end != std::string::npos) {
        const std::string first = text_.substr(0, end);
        text_.erase(0, end + 1);
        return first;
      }
      pollfd ready{out_, POLLIN, 0};
      if (poll(&ready, 1, 60000) <= 0) return "";
      char bytes[4096];
      const ssize_t count = read(out_, bytes, sizeof bytes);
      if (count <= 0) return "";
      text_.append(bytes, std::size_t(count));
    }
  }
  std::string err() const { return contents(errPath_); }
  /// Its exit status, or minus the signal that ended it.
  int wait() {
    int status = 0;
    waitpid(child_, &status, 0);
    child_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }

 private:
  const std::string errPath_ = temporaryFolder() + "/running.err";
  pid_t child_ = -1;
  int in_ = -1, out_ = -1;
  std::string text_;
};

/// Runs the binary with `text` coming through a pipe.
inline Ran piped(const std::string& text, const Arguments& arguments) {
  Running run(arguments);
  run.write(text);
  run.closeIn();
  Ran ran;
  for (std::string line = run.line(); !line.empty(); line = run.line()) ran.out += line + "\n";
  ran.status = run.wait();
  ran.err = run.err();
  return ran;
}

}  // namespace glint::test
