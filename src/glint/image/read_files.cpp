#include "glint/image/read_files.h"

#include <fcntl.h>
#include <sys/stat.h>

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <unordered_set>

namespace glint {
namespace {

std::atomic<bool> isProtecting = false;
std::mutex mutex;
std::unordered_set<std::uint64_t> noted;  // 64-bit keys of files and of paths

std::uint64_t mixed(std::uint64_t state, std::uint64_t word) {
  state = (state ^ word) * 0x9e3779b97f4a7c15u;
  return state ^ (state >> 29);
}

/// The key of a regular file; empty if it does not exist or is something else.
std::optional<std::uint64_t> fileKey(int folder, const char* path, int flags) {
  struct statx status {};
  if (::statx(folder, path, flags, STATX_BASIC_STATS | STATX_BTIME, &status) != 0) return {};
  if (!S_ISREG(status.stx_mode)) return {};
  std::uint64_t key = mixed(1, status.stx_ino);
  key = mixed(key, std::uint64_t(status.stx_dev_major) << 32 | status.stx_dev_minor);
  if (status.stx_mask & STATX_BTIME) {
    key = mixed(key, std::uint64_t(status.stx_btime.tv_sec));
    key = mixed(key, status.stx_btime.tv_nsec);
  }
  return key;
}

std::optional<std::uint64_t> fileKey(const std::string& path) {
  return fileKey(AT_FDCWD, path.c_str(), 0);
}

std::uint64_t pathKey(const std::string& path) {
  std::error_code error;
  std::filesystem::path plain = std::filesystem::weakly_canonical(path, error);
  if (error) plain = std::filesystem::absolute(path, error).lexically_normal();
  return mixed(2, std::hash<std::string>()(plain.string()));
}

void note(const std::optional<std::uint64_t>& file, const std::string& path) {
  if (!file) return;
  const std::uint64_t name = pathKey(path);
  const std::lock_guard lock(mutex);
  noted.insert(*file);
  noted.insert(name);
}

}  // namespace

void protectReadFiles() { isProtecting = true; }

void noteReadFile(const std::string& path) {
  if (isProtecting) note(fileKey(path), path);
}

void noteReadFile(int descriptor, const std::string& path) {
  if (isProtecting) note(fileKey(descriptor, "", AT_EMPTY_PATH), path);
}

void forgetReadFile(const std::string& path) {
  if (!isProtecting) return;
  const auto file = fileKey(path);
  const std::uint64_t name = pathKey(path);
  const std::lock_guard lock(mutex);
  if (file) noted.erase(*file);
  noted.erase(name);
}

bool isReadFile(const std::string& path) {
  if (!isProtecting) return false;
  const auto file = fileKey(path);
  struct stat status {};
  if (!file && ::stat(path.c_str(), &status) == 0) return false;  // a device may be written to
  const std::uint64_t name = pathKey(path);
  const std::lock_guard lock(mutex);
  return (file && noted.contains(*file)) || noted.contains(name);
}

}  // namespace glint
