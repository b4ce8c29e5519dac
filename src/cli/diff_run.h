#pragma once

#include <string>
#include <vector>

#include "diff_pair.h"

namespace glint {

/// What `glint diff` is asked to do.
struct DiffRequest {
  std::string a, b;                         ///< two pictures or two folders
  std::string testRun;                      ///< instead of a and b, a folder left by image tests
  DiffSettings settings;                    ///< for each pair
  std::string conditions;                   ///< a file of settings for some pairs; empty: A's own
  std::string json, junit, markdown, html;  ///< reports; empty: none
  bool picturesBeside = false;              ///< not embedded in the page
  std::string mask;                         ///< a picture; empty: none
  bool updating = false;                    ///< makes B the baseline
  std::vector<std::string> named;           ///< only these pairs; empty: all
  bool pruning = false;                     ///< removes baselines without a picture
  bool perDriver = false;                   ///< baselines are kept in one folder per driver
  int jobs = 0;                             ///< 0: as many as the processor has cores
};

/// Compares, writes the reports and returns the exit status.
int runDiff(DiffRequest request);

}  // namespace glint
