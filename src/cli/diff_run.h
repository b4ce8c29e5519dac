#pragma once

#include <string>
#include <vector>

#include "diff_pair.h"

namespace glint {

/// What `glint diff` is asked to do.
struct DiffRequest {
  std::string a, b;                ///< two pictures or two folders
  DiffSettings settings;           ///< of each pair
  std::string json, junit, html;   ///< reports; empty: none
  std::string mask;                ///< a picture; empty: none
  bool updating = false;           ///< make B the baseline
  std::vector<std::string> named;  ///< only of these pairs; empty: of all
  bool perDriver = false;          ///< baselines are kept in folders of drivers
  int jobs = 0;                    ///< 0: as many as the processor has
};

/// Compares, writes the reports, and gives the exit status.
int runDiff(DiffRequest request);

}  // namespace glint
