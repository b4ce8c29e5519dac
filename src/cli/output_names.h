#pragma once

#include <string>
#include <vector>

namespace glint {

/// The output names of a template for the given models: {model} is the model file's name without
/// folder and ending, {n} its number from 0, zero-padded. Throws InputError for an unknown {key},
/// an unfinished one, and for two pictures of one name.
std::vector<std::string> outputNames(const std::string& pattern,
                                     const std::vector<std::string>& models);

}  // namespace glint
