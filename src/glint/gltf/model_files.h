#pragma once

#include <string>

namespace glint {

/// Records a model and the files that its JSON names as read (read_files.h) before they are read,
/// so that no output can overwrite them. Looks only at the JSON; faults in the model are reported
/// when it is loaded.
void noteModelFiles(const std::string& path);

}  // namespace glint
