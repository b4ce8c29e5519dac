#pragma once

namespace glint {

/// To be called first of all in main(): the descriptors 0 to 2 are opened where they are closed, so
/// that no file gets the number of a standard stream (reading and writing such a stream fails as it
/// should); a file beyond the limit of sizes becomes an error of writing in place of a signal that
/// ends the process without a word; and files that are read are not written over (read_files.h).
void prepareProcess();

}  // namespace glint
