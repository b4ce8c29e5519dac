#pragma once

// Files and folders for tests, and messages about broken ones.

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "glint/image/error.h"

namespace glint::test {

/// A folder for this process only; created on first use, never removed.
inline std::string temporaryFolder() {
  static const std::string folder = [] {
    std::string name = testing::TempDir() + "glint_tests_" + std::to_string(getpid());
    std::filesystem::create_directories(name);
    return name;
  }();
  return folder;
}

/// An empty folder for one test.
class Folder {
 public:
  explicit Folder(const std::string& name) : path_(temporaryFolder() + "/" + name) {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::permissions(path_, std::filesystem::perms::owner_all, ignored);
    std::filesystem::remove_all(path_, ignored);
  }
  std::string operator/(const std::string& name) const { return path_ + "/" + name; }
  const std::string& path() const { return path_; }
  /// The names in it, including hidden ones, sorted.
  std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(path_))
      names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
  }

 private:
  std::string path_;
};

inline std::string contents(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

inline void writeText(const std::string& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

inline std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// The parts of a text between the `|` in it.
inline std::vector<std::string> partsOf(const std::string& text) {
  std::vector<std::string> parts;
  std::istringstream in(text + "|");
  for (std::string part; std::getline(in, part, '|');) parts.push_back(part);
  return parts;
}

inline std::vector<std::byte> bytesOf(std::string_view text) {
  const auto* begin = reinterpret_cast<const std::byte*>(text.data());
  return {begin, begin + text.size()};
}

/// The message of the InputError that `action` throws, which is one line; "no error" without one.
template <typename Action>
std::string messageOf(const Action& action) {
  try {
    action();
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.find('\n'), message.npos) << message;
    return message;
  }
  return "no error";
}

}  // namespace glint::test
