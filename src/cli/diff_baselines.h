#pragma once

#include <string>
#include <vector>

#include "diff_report.h"

namespace glint {

/// Whether the ending is that of a picture.
bool isPictureName(const std::string& path);

/// Throws InputError for a name or pattern of --update that no pair has.
void checkNames(const std::vector<std::string>& named, const std::vector<DiffEntry>& entries);

/// Makes B the baseline `target` where it is wanted (by one of the names, or all) and not the same,
/// and says so.
void update(const std::vector<std::string>& named, DiffEntry& entry, const std::string& target);

/// Removes a baseline that has no picture, and says so.
void prune(DiffEntry& entry);

}  // namespace glint
