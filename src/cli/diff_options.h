#pragma once

#include <string>
#include <utility>
#include <vector>

#include "diff_pair.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace glint {

/// The options of a comparison as they are given: on the command line, or in a file for some pairs.
struct ComparisonArguments {
  std::vector<std::string> metricNames, thresholds, maxPixels, ignored;
  std::string alpha = "straight", values = "stored", mask, layer = "all", screen,
              toneMapper = "aces", pixelmatch = "7";
  double tolerance = 0.1, pixelsPerDegree = 0;
  std::string startExposure, stopExposure;
  int exposures = 0, shift = 0, window = 0;
  bool ignoreAntiAliasing = false;
  CLI::Option *metric = nullptr, *threshold = nullptr;  ///< whose order counts
};

/// Adds them to a command, which must live as long as they are read.
void addComparisonOptions(CLI::App& command, ComparisonArguments& given);

/// What they say, the command having been parsed. Reads the mask; a relative path of it is one in
/// `folder`, if that is not empty. Throws InputError.
DiffSettings comparisonSettings(const CLI::App& command, const ComparisonArguments& given,
                                const std::string& folder = "");

/// Pairs of a folder that are compared in ways of their own.
struct PairConditions {
  std::string pattern;  ///< of names, with * and ?
  DiffSettings settings;
  std::string where;  ///< "FILE:LINE: "
};

/// Reads a file of lines "PATTERN OPTION...", the options as on the command line; # begins a
/// comment. Throws InputError that names the line.
std::vector<PairConditions> readConditions(const std::string& path);

/// Whether a name is meant by a pattern: it is the name; or * and ? stand for letters, / too; or
/// the name lies in the folder that it names.
bool isNamedBy(const std::string& pattern, const std::string& name);

}  // namespace glint
