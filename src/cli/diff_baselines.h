#pragma once

#include <set>
#include <string>
#include <vector>

#include "diff_report.h"

namespace glint {

/// Whether the file name has the extension of a picture format.
bool isPictureName(const std::string& path);

/// The names of the pairs that --update selects. A name is an exact pair name, or else a pattern or
/// a folder; no names select all pairs. A leading "./" is ignored (-a.png would be an option).
/// Throws InputError for a name that matches no pair.
std::set<std::string> namesMeant(const std::vector<std::string>& named,
                                 const std::vector<DiffEntry>& entries);

/// Copies B over the baseline `target` if the pair is selected and is not the same, and reports it.
void update(const std::set<std::string>& meant, DiffEntry& entry, const std::string& target);

/// Removes a baseline that has no picture, and reports it.
void prune(DiffEntry& entry);

}  // namespace glint
