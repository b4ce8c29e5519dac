#pragma once

#include <string>

namespace glint {

// The files that this process reads, so that it does not write over them. A program that wants so
// calls protectReadFiles() once; from then on readFile() and all who open files of a model note
// what they open, by device, inode and time of birth (a name is not enough: there are links; an
// inode alone is given to a new file when an old one has gone) and by the path in its plain form,
// and OutputFile refuses to write there. It costs some 80 bytes a file. Any thread may call these.

void protectReadFiles();

/// Notes a file that is read, or will be. What does not exist and what is no regular file (a
/// device, a FIFO) is passed over.
void noteReadFile(const std::string& path);
/// The same of a file that is open.
void noteReadFile(int descriptor, const std::string& path);

/// Takes back the note of a file that is read no more and may be replaced: a baseline that is
/// updated, a model that is edited in place.
void forgetReadFile(const std::string& path);

/// Whether writing to the path would change a file that has been noted.
bool isReadFile(const std::string& path);

}  // namespace glint
