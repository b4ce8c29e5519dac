#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "glint/image/made_folders.h"

namespace glint {

/// A path, or any other input, as error messages show it (printable.h): on one line and never
/// empty.
std::string printablePath(std::string_view path);

/// Whether nothing has this name. False where that cannot be told (no permission, a link loop):
/// reading the file then says why.
bool isMissing(const std::string& path);

/// "No space left on device: free some space or write elsewhere" for an errno from writing.
std::string writeFailure(int error);

/// Whether reading a file is recorded (read_files.h). `no` is for files the program itself has
/// written.
enum class Noted { yes, no };

/// The largest file that is read whole, in bytes.
inline constexpr std::uint64_t maxFileBytes = std::uint64_t(4) << 30;

/// The bytes of a regular file (symbolic links are followed).
/// Throws InputError "PATH: what: what to do" if the file is missing, unreadable or larger than
/// maxFileBytes, and for a folder, FIFO, socket or device, which are refused without blocking.
std::vector<std::byte> readFile(const std::string& path, Noted noted = Noted::yes);

/// A file that appears whole or not at all: what is written stays invisible until commit(). Without
/// commit() nothing is left behind, and an older file of that name stays as it was.
///
/// The path "-" is standard output, and a path that exists and is not a regular file (/dev/null, a
/// FIFO) is written directly; output written there before an error cannot be taken back. A symbolic
/// link is kept, and the file it points to is replaced. Missing folders are created, and removed
/// again if they stay empty. New files have the permissions 0666 less the umask.
///
/// A file that this process reads (read_files.h) is refused, both when it is opened and at
/// commit().
///
/// All members throw InputError: missing folder, no permission, disk full.
class OutputFile {
 public:
  enum class Staging {
    unnamed,  ///< an unnamed file (O_TMPFILE) if the file system supports it, else as `named`
    named,    ///< a file ".NAME.XXXXXX" next to the target; a killed process leaves it behind
  };

  explicit OutputFile(const std::string& path, Staging staging = Staging::unnamed);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Appends. Small pieces are collected, so an error may be reported by a later call.
  void write(std::span<const std::byte> bytes);
  void write(std::string_view text) { write(std::as_bytes(std::span(text))); }

  /// Writes at an offset in bytes from the beginning, which may lie beyond the current end (the gap
  /// reads as zeros). Not for standard output, FIFOs and sockets. Must not be mixed with write().
  void writeAt(std::uint64_t offset, std::span<const std::byte> bytes);

  /// Puts the file in its place. Nothing can be written after that.
  void commit();

 private:
  void openStaged(Staging staging);
  bool staged(Staging staging);
  void flush();
  void writeAll(std::span<const std::byte> bytes, std::int64_t offset);
  void link();
  void refuseReadFile() const;
  [[noreturn]] void fail(int error) const;

  MadeFolders folders_;    ///< outlives the file, so that empty folders are removed
  std::string path_;       ///< as the user gave it, for messages
  std::string target_;     ///< symbolic links resolved; empty if written directly
  std::string temporary_;  ///< the named file to delete if there is no commit
  int file_ = -1;
  std::vector<std::byte> pending_;
};

}  // namespace glint
