#pragma once

#include <string>

#include "diff_html.h"
#include "diff_report.h"
#include "glint/image/difference_picture.h"

namespace glint {

struct DiffSettings {
  CompareOptions compare;
  bool allMetrics = false;  ///< not only those of the conditions
  bool html = false;
  std::string output;  ///< of the difference picture; empty: none
  DifferenceKind difference = DifferenceKind::flip;
  double scale = 1;
  std::string layer;
};

/// Compares one pair; never throws for what is wrong with it but notes it.
void diffPair(const DiffSettings& settings, DiffEntry& entry, PairPictures* pictures);

/// The path of an entry's baseline for the driver that drew B.
std::string driverBaseline(const std::string& folder, const DiffEntry& entry);
/// Makes that the entry's baseline if there is one.
void useDriverBaseline(const std::string& folder, DiffEntry& entry);

}  // namespace glint
