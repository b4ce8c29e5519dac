#include "glint/image/file.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <climits>
#include <cstring>
#include <new>
#include <random>
#include <system_error>

#include "glint/image/error.h"
#include "glint/image/printable.h"
#include "glint/image/read_files.h"

namespace glint {
namespace {

constexpr std::size_t pendingLimit = std::size_t(1) << 16;

std::string words(int error) { return std::generic_category().message(error); }

std::string readAdvice(int error) {
  switch (error) {
    case ENOENT:
    case ENOTDIR:
      return "check the path";
    case EACCES:
    case EPERM:
      return "check its permissions";
    case ELOOP:
      return "check where its links lead";
    case ENAMETOOLONG:
      return "give a shorter path";
    default:
      return "check the disk and the file";
  }
}

std::string writeAdvice(int error) {
  switch (error) {
    case ENOTDIR:
      return "a part of its path is a file: write elsewhere";
    case EACCES:
    case EPERM:
    case EROFS:
      return "write elsewhere or change the permissions";
    case ENOSPC:
    case EDQUOT:
      return "free some space or write elsewhere";
    case EFBIG:
      return "raise the limit of file sizes (ulimit -f) or write elsewhere";
    case EBADF:
      return "it is closed: open it or write elsewhere";
    case EPIPE:
      return "the reader of the output has closed it";
    case ESPIPE:
      return "this format needs a regular file";
    case EISDIR:
      return "give the name of a file";
    default:
      return "write elsewhere";
  }
}

/// Closes the descriptor on every exit path.
struct Descriptor {
  int number;
  ~Descriptor() {
    if (number >= 0) ::close(number);
  }
};

std::string folderOf(const std::string& path) {
  const auto slash = path.rfind('/');
  if (slash == std::string::npos) return ".";
  return slash == 0 ? "/" : path.substr(0, slash);
}

/// The path that a write to `path` would end up at, whether or not the file exists yet.
std::string followLinks(std::string path) {
  for (int depth = 0; depth < 40; ++depth) {
    char to[PATH_MAX];
    const ssize_t length = ::readlink(path.c_str(), to, sizeof to);
    if (length < 0) break;  // not a link, or nothing there
    const std::string next(to, static_cast<std::size_t>(length));
    path = next.starts_with('/') ? next : folderOf(path).append("/").append(next);
  }
  return path;
}

std::string siblingName(const std::string& target) {
  static constexpr char letters[] = "abcdefghijklmnopqrstuvwxyz0123456789";
  std::random_device random;
  std::string name(6, ' ');
  for (char& letter : name) letter = letters[random() % 36];
  const auto slash = target.rfind('/');
  const std::string base = slash == std::string::npos ? target : target.substr(slash + 1);
  return folderOf(target) + "/." + base.substr(0, 200) + "." + name;
}

std::string openFilePath(int file) { return "/proc/self/fd/" + std::to_string(file); }

}  // namespace

std::string printablePath(std::string_view path) { return path.empty() ? "''" : printable(path); }

bool isMissing(const std::string& path) {
  struct stat status {};
  return ::stat(path.c_str(), &status) != 0 && (errno == ENOENT || errno == ENOTDIR);
}

std::string writeFailure(int error) { return words(error) + ": " + writeAdvice(error); }

std::vector<std::byte> readFile(const std::string& path, Noted noted) {
  const auto refuse = [&](const std::string& what) {
    return InputError(printablePath(path) + ": " + what);
  };
  // O_NONBLOCK: a FIFO without a writer must not block.
  const Descriptor file{::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)};
  struct stat status {};
  if (file.number < 0 || ::fstat(file.number, &status) != 0) {
    throw refuse(words(errno) + ": " + readAdvice(errno));
  }
  if (!S_ISREG(status.st_mode)) {
    throw refuse(S_ISDIR(status.st_mode) ? "Is a directory: give the name of a file"
                                         : "not a regular file: save it to a file first");
  }
  if (noted == Noted::yes) noteReadFile(file.number, path);
  const auto checkLength = [&](std::uint64_t length) {
    if (length > maxFileBytes) throw refuse("larger than 4 GiB: give a smaller file");
  };
  checkLength(static_cast<std::uint64_t>(status.st_size));
  try {
    std::vector<std::byte> bytes(static_cast<std::size_t>(status.st_size));
    std::size_t done = 0;
    for (;;) {
      // A file of unknown length (in /proc) or one that grows is read to its actual end.
      std::byte extra[4096];
      const bool full = done == bytes.size();
      const ssize_t count = ::read(file.number, full ? extra : bytes.data() + done,
                                   full ? sizeof extra : bytes.size() - done);
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) throw refuse(words(errno) + ": " + readAdvice(errno));
      if (count == 0) break;
      if (full) bytes.insert(bytes.end(), extra, extra + count);
      done += static_cast<std::size_t>(count);
      checkLength(done);
    }
    bytes.resize(done);
    return bytes;
  } catch (const std::bad_alloc&) {
    throw refuse("not enough memory: give a smaller file");
  } catch (const std::length_error&) {
    throw refuse("not enough memory: give a smaller file");
  }
}

OutputFile::OutputFile(const std::string& path, Staging staging) : path_(path) {
  if (path == "-") {
    path_ = "standard output";
    file_ = ::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 0);
    if (file_ < 0) fail(errno);
    return;
  }
  struct stat status {};
  if (::stat(path.c_str(), &status) == 0) {
    if (S_ISDIR(status.st_mode)) fail(EISDIR);
    // Replacing a file needs no permission on it, but a write-protected file is left alone.
    if (::faccessat(AT_FDCWD, path.c_str(), W_OK, AT_EACCESS) != 0) fail(errno);
    if (!S_ISREG(status.st_mode)) {
      file_ = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
      if (file_ < 0) fail(errno);
      return;
    }
  }
  refuseReadFile();
  target_ = followLinks(path);
  if (target_.empty() || target_.ends_with('/')) fail(target_.empty() ? ENOENT : EISDIR);
  openStaged(staging);
}

OutputFile::~OutputFile() {
  if (file_ >= 0) ::close(file_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void OutputFile::openStaged(Staging staging) {
  if (staged(staging)) return;
  // The folder may be removed between the two calls if another output that needed it has failed.
  for (int attempt = 0; errno == ENOENT && attempt < 3; ++attempt) {
    if (const std::error_code error = folders_.make(folderOf(target_))) fail(error.value());
    if (staged(staging)) return;
  }
  fail(errno);
}

/// Opens the file that will be given the target's name. On failure returns false and sets errno.
bool OutputFile::staged(Staging staging) {
  if (staging == Staging::unnamed) {
    file_ = ::open(folderOf(target_).c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
    // Without /proc the file could not be given a name.
    if (file_ >= 0 && ::access(openFilePath(file_).c_str(), F_OK) == 0) return true;
    if (file_ >= 0) ::close(file_);
  }
  do {
    temporary_ = siblingName(target_);
    file_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  } while (file_ < 0 && errno == EEXIST);
  if (file_ < 0) temporary_.clear();
  return file_ >= 0;
}

void OutputFile::write(std::span<const std::byte> bytes) {
  if (pending_.size() + bytes.size() > pendingLimit) flush();
  if (bytes.size() >= pendingLimit) return writeAll(bytes, -1);
  if (pending_.capacity() == 0) pending_.reserve(pendingLimit);
  pending_.insert(pending_.end(), bytes.begin(), bytes.end());
}

void OutputFile::writeAt(std::uint64_t offset, std::span<const std::byte> bytes) {
  writeAll(bytes, static_cast<std::int64_t>(offset));
}

void OutputFile::flush() {
  writeAll(pending_, -1);
  pending_.clear();
}

void OutputFile::writeAll(std::span<const std::byte> bytes, std::int64_t offset) {
  while (!bytes.empty()) {
    const ssize_t count = offset < 0 ? ::write(file_, bytes.data(), bytes.size())
                                     : ::pwrite(file_, bytes.data(), bytes.size(), offset);
    if (count < 0 && errno == EAGAIN) {  // standard output may be a shared non-blocking pipe
      pollfd ready{file_, POLLOUT, 0};
      ::poll(&ready, 1, -1);
    } else if (count < 0 && errno != EINTR) {
      fail(errno);
    } else if (count > 0) {
      bytes = bytes.subspan(static_cast<std::size_t>(count));
      if (offset >= 0) offset += count;
    }
  }
}

void OutputFile::commit() {
  if (!target_.empty()) refuseReadFile();
  flush();
  if (!target_.empty() && temporary_.empty()) link();
  // Some file systems report a full disk only here, so the file gets its name afterwards.
  const int closed = ::close(file_);
  file_ = -1;
  if (closed != 0 && errno != EINTR) fail(errno);
  if (temporary_.empty()) return;
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail(errno);
  temporary_.clear();
}

/// Names the unnamed file: directly if the name is free, else next to the target, for renaming.
void OutputFile::link() {
  const std::string unnamed = openFilePath(file_);
  const auto linkTo = [&](const std::string& name) {
    return ::linkat(AT_FDCWD, unnamed.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0;
  };
  if (linkTo(target_)) return;
  if (errno == ENOENT && !folders_.make(folderOf(target_)) && linkTo(target_)) return;
  while (errno == EEXIST) {
    const std::string name = siblingName(target_);
    if (linkTo(name)) {
      temporary_ = name;
      return;
    }
  }
  fail(errno);
}

void OutputFile::refuseReadFile() const {
  if (isReadFile(path_))
    throw InputError(printablePath(path_) +
                     ": is an input file and would be overwritten: give another name");
}

void OutputFile::fail(int error) const {
  throw InputError(printablePath(path_) + ": " + writeFailure(error));
}

}  // namespace glint
