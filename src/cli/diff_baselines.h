#pragma once

#include <string>
#include <vector>

#include "diff_report.h"

namespace glint {

/// The ending of a file's name in lower case, with its dot.
std::string endingOf(const std::string& path);

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
