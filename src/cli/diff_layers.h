#pragma once

#include <string>
#include <utility>
#include <vector>

#include "diff_report.h"
#include "glint/image/picture_layers.h"

namespace glint {

/// Two layers with the same name.
struct LayerPair {
  const PictureLayer *a = nullptr, *b = nullptr;

  int width() const { return std::max(a->image.width, b->image.width); }
  int height() const { return std::max(a->image.height, b->image.height); }
  /// The smallest and the largest value in both.
  std::pair<float, float> range() const;
};

struct LayerPairs {
  std::vector<LayerPair> matched;    ///< the main picture first
  std::vector<std::string> missing;  ///< failures: layers that only one picture has
  std::size_t shown = 0;             ///< the first that is not equal; the main one if all are
};

/// The smallest and the largest finite value; 0 and 1 if there is none.
std::pair<float, float> rangeOf(const StoredImage& image);

/// Matches layers by name, and notes what is not compared and which metadata is ignored.
LayerPairs matchLayers(const PictureLayers& a, const PictureLayers& b, DiffEntry& entry);

/// Compares two layers and adds the result to the entry. Layers that are not colours are judged by
/// the conditions on values (max, mean, rmse, relative-rmse, psnr). A difference that none of them
/// judges is reported, and is a failure if no colours are judged either.
void addLayer(const LayerPair& pair, const CompareOptions& options, bool first, bool besideColours,
              DiffEntry& entry);

/// The factor that makes the largest difference white.
double shownScale(const LayerPair& pair);

}  // namespace glint
