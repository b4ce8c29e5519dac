#pragma once

#include <memory>
#include <string>

#include "diff_html.h"
#include "diff_report.h"
#include "glint/image/difference_picture.h"

namespace glint {

struct DiffSettings {
  CompareOptions compare;
  std::shared_ptr<const StoredImage> mask;  ///< what compare.mask points to
  std::string maskPath;
  bool allMetrics = false;  ///< not only those of the conditions
  std::string output;       ///< of the difference picture; empty: none
  DifferenceKind difference = DifferenceKind::flip;
  double scale = 1;
  std::string layer = "all";
};

/// Compares one pair; never throws for what is wrong with it but notes it. Of several baselines the
/// one that is nearest counts.
void diffPair(const DiffSettings& settings, DiffEntry& entry, PairPictures* pictures);

/// A picture's bytes; "-" is stdin, which is read once.
std::vector<std::byte> pictureBytes(const std::string& path);

/// The path of an entry's baseline for the driver that drew B.
std::string driverBaseline(const std::string& folder, const DiffEntry& entry);
/// Makes that the entry's baseline if there is one.
void useDriverBaseline(const std::string& folder, DiffEntry& entry);

/// The baselines beside one: NAME_1.png, NAME_2.png ... of NAME.png, as many as there are.
std::vector<std::string> otherBaselines(const std::string& path);

}  // namespace glint
