#pragma once

namespace glint {

/// Call this first in main(). It opens any closed descriptor from 0 to 2, so that no file gets the
/// number of a standard stream (using such a stream fails as it should); turns exceeding the file
/// size limit into a write error instead of a signal that silently ends the process; and protects
/// files that are read from being overwritten (read_files.h).
void prepareProcess();

}  // namespace glint
