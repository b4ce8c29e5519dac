#pragma once

#include <string>

namespace glint {

// The files that this process reads, so that it does not overwrite them. A program that wants this
// protection calls protectReadFiles() once. From then on readFile() and all code that opens a
// model's files record what they open, both by device, inode and birth time (a name is not enough
// because of links; an inode may be reused once a file is deleted) and by the normalised path, and
// OutputFile refuses to write there. It costs about 80 bytes a file. These functions are
// thread-safe.

void protectReadFiles();

/// Records a file that is or will be read. Paths that do not exist or are not regular files (a
/// device, a FIFO) are skipped.
void noteReadFile(const std::string& path);
/// The same for an open file.
void noteReadFile(int descriptor, const std::string& path);

/// Removes the record of a file that is no longer read and may be replaced: a baseline that is
/// updated, a model that is edited in place.
void forgetReadFile(const std::string& path);

/// Whether writing to the path would change a recorded file.
bool isReadFile(const std::string& path);

}  // namespace glint
