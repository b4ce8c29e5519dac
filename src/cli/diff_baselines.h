#pragma once

#include <set>
#include <string>
#include <vector>

#include "diff_report.h"

namespace glint {

/// Whether the ending is that of a picture.
bool isPictureName(const std::string& path);

/// The names of the pairs that --update means: a name is that pair's alone, or else it is a pattern
/// or a folder; none means all. "./" before a name is passed over (-a.png would be an option).
/// Throws InputError for one that no pair has.
std::set<std::string> namesMeant(const std::vector<std::string>& named,
                                 const std::vector<DiffEntry>& entries);

/// Makes B the baseline `target` where it is meant and not the same, and says so.
void update(const std::set<std::string>& meant, DiffEntry& entry, const std::string& target);

/// Removes a baseline that has no picture, and says so.
void prune(DiffEntry& entry);

}  // namespace glint
