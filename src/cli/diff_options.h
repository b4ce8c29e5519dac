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

/// The options of a comparison as given: on the command line, or in a file for some pairs.
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

/// The place of a word among those that an option takes. Throws InputError for any other.
int choiceOf(const std::string& text, std::initializer_list<std::string_view> words,
             const char* option);

/// Adds the options to a command, which must live until `given` has been read.
void addComparisonOptions(CLI::App& command, ComparisonArguments& given);

/// The settings that the options of a parsed command give. Reads the mask; its relative path is
/// resolved in `folder` unless that is empty. Throws InputError.
DiffSettings comparisonSettings(const CLI::App& command, const ComparisonArguments& given,
                                const std::string& folder = "");

/// Pairs of a folder that have comparison settings of their own.
struct PairConditions {
  std::string pattern;  ///< of names, with * and ?
  DiffSettings settings;
  std::string where;  ///< "FILE:LINE: "
};

/// Reads a file of lines "PATTERN OPTION...", with the options of the command line; # begins a
/// comment. Throws an InputError that names the line.
std::vector<PairConditions> readConditions(const std::string& path);

/// Whether a pattern matches a name: it equals the name, or matches it with the wildcards * and ?
/// (which match / too), or is a folder that contains the name.
bool isNamedBy(const std::string& pattern, const std::string& name);

}  // namespace glint
