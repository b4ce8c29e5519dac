#pragma once

#include <string>
#include <vector>

#include "diff_options.h"
#include "diff_run.h"

namespace glint {

/// The conditions of single pairs: those of the file that is given, or of A's own. Throws
/// InputError.
std::vector<PairConditions> conditionsOf(const DiffRequest& request);

/// The pairs of two folders, by name. Throws InputError if there are none.
std::vector<DiffEntry> pairsOf(const DiffRequest& request,
                               const std::vector<PairConditions>& conditions);

/// The settings of a pair: those of the last line of the conditions that names it, with what the
/// command line says of reports.
DiffSettings settingsFor(const DiffSettings& given, const std::vector<PairConditions>& conditions,
                         const std::string& name);

/// Prints the lines of the conditions that name no pair.
void tellUnused(const std::vector<PairConditions>& conditions,
                const std::vector<DiffEntry>& entries);

}  // namespace glint
