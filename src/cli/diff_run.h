#pragma once

#include <string>
#include <vector>

#include "diff_pair.h"

namespace glint {

/// What `glint diff` is asked to do.
struct DiffRequest {
  std::string a, b;                         ///< two pictures or two folders
  std::string testRun;                      ///< instead of them a folder that image tests left
  DiffSettings settings;                    ///< of each pair
  std::string conditions;                   ///< a file of settings for some; empty: A's own
  std::string json, junit, markdown, html;  ///< reports; empty: none
  bool picturesBeside = false;              ///< not in the page
  std::string mask;                         ///< a picture; empty: none
  bool updating = false;                    ///< make B the baseline
  std::vector<std::string> named;           ///< only of these pairs; empty: of all
  bool pruning = false;                     ///< remove baselines without a picture
  bool perDriver = false;                   ///< baselines are kept in folders of drivers
  int jobs = 0;                             ///< 0: as many as the processor has
};

/// Compares, writes the reports, and gives the exit status.
int runDiff(DiffRequest request);

}  // namespace glint
