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
  bool allMetrics = false;  ///< not only those with conditions
  std::string output;       ///< the difference picture; empty: none
  DifferenceKind difference = DifferenceKind::flip;
  double scale = 1;
  std::string layer = "all";
};

/// Compares one pair. Never throws for a fault of the pair but records it in the entry. If there
/// are several baselines, the nearest one counts.
void diffPair(const DiffSettings& settings, DiffEntry& entry, PairPictures* pictures);

/// The bytes of a picture; "-" is stdin, which is read once.
std::vector<std::byte> pictureBytes(const std::string& path);

/// The path of the entry's baseline for the driver that drew B.
std::string driverBaseline(const std::string& folder, const DiffEntry& entry);
/// Makes that path the entry's baseline if it exists.
void useDriverBaseline(const std::string& folder, DiffEntry& entry);

/// Further baselines: NAME_1.png, NAME_2.png ... of NAME.png, up to the first that does not exist.
std::vector<std::string> otherBaselines(const std::string& path);

}  // namespace glint
