#pragma once

#include <string>

namespace glint {

/// Notes a model and the files that its JSON names as read (read_files.h), before they are: so that
/// no output is one of them. Looks at the JSON alone; what is wrong with the model is told when it
/// is loaded.
void noteModelFiles(const std::string& path);

}  // namespace glint
