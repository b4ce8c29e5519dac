#pragma once

#include <string>
#include <vector>

#include "diff_options.h"
#include "diff_run.h"

namespace glint {

/// The conditions for individual pairs, from the given file or from the one in A. Throws
/// InputError.
std::vector<PairConditions> conditionsOf(const DiffRequest& request);

/// The pairs of two folders, matched by name. Throws InputError if there are none.
std::vector<DiffEntry> pairsOf(const DiffRequest& request,
                               const std::vector<PairConditions>& conditions);

/// The settings of a pair: those of the last matching line of the conditions, with the report
/// options of the command line.
DiffSettings settingsFor(const DiffSettings& given, const std::vector<PairConditions>& conditions,
                         const std::string& name);

/// Prints the lines of the conditions that match no pair.
void tellUnused(const std::vector<PairConditions>& conditions,
                const std::vector<DiffEntry>& entries);

}  // namespace glint
