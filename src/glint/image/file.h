#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "glint/image/made_folders.h"

namespace glint {

/// A path, or anything else that was given, as error messages show it (printable.h): on one line,
/// and never nothing.
std::string printablePath(std::string_view path);

/// "No space left on device: free some space or write elsewhere" for an errno of writing.
std::string writeFailure(int error);

/// Whether a file that is read is noted (read_files.h). Not what the program has written itself.
enum class Noted { yes, no };

/// What is longer is not read whole: bytes.
inline constexpr std::uint64_t maxFileBytes = std::uint64_t(4) << 30;

/// The bytes of a regular file (symbolic links are followed).
/// Throws InputError "PATH: what: what to do" for a missing or unreadable file, for one of more
/// than maxFileBytes and for a folder, a FIFO, a socket or a device, which are refused without
/// waiting for them.
std::vector<std::byte> readFile(const std::string& path, Noted noted = Noted::yes);

/// A file that appears whole or not at all: what is written stays invisible until commit(), and
/// without commit() nothing is left and an older file of that name stays as it was.
///
/// The path "-" is standard output, and a path that exists and is not a regular file (/dev/null, a
/// FIFO) is written directly; there what was written before an error cannot be taken back. A
/// symbolic link stays, and the file it points to is replaced. Folders that are missing are made,
/// and go again if nothing comes into them. New files have the permissions 0666 less the umask.
///
/// A file that this process reads (read_files.h) is refused, when it is opened and again at
/// commit().
///
/// All members throw InputError: missing folder, no permission, disk full.
class OutputFile {
 public:
  enum class Staging {
    unnamed,  ///< an unnamed file (O_TMPFILE) where the file system has them, else as `named`
    named,    ///< a file ".NAME.XXXXXX" beside the target; a killed process leaves it behind
  };

  explicit OutputFile(const std::string& path, Staging staging = Staging::unnamed);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Appends. Small pieces are collected, so an error may be reported by a later call.
  void write(std::span<const std::byte> bytes);

  /// Writes at an offset in bytes from the beginning, which may lie beyond the end so far (the gap
  /// reads as zeros). Not for standard output, FIFOs and sockets. Not to be mixed with write().
  void writeAt(std::uint64_t offset, std::span<const std::byte> bytes);

  /// Puts the file in its place. Nothing may be written afterwards.
  void commit();

 private:
  void openStaged(Staging staging);
  bool staged(Staging staging);
  void flush();
  void writeAll(std::span<const std::byte> bytes, std::int64_t offset);
  void link();
  void refuseReadFile() const;
  [[noreturn]] void fail(int error) const;

  MadeFolders folders_;    ///< outlives the file, so that empty ones go
  std::string path_;       ///< as the user gave it, for messages
  std::string target_;     ///< with links followed; empty when written directly
  std::string temporary_;  ///< the named file that must go if there is no commit
  int file_ = -1;
  std::vector<std::byte> pending_;
};

}  // namespace glint
