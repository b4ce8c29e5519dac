#pragma once

#include <memory>
#include <string>

#include "glint/image/compare.h"

namespace glint {

enum class DifferenceKind { flip, absolute, sideBySide };

/// Writes the rows of a FLIP map as a picture of its colours (Magma). The rows come in order.
class FlipPicture {
 public:
  FlipPicture(const std::string& path, int width, int height);
  ~FlipPicture();
  void add(const float* errors);
  void finish();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// Writes a picture of the differences between two pictures (padded if their sizes differ): FLIP's
/// map in Magma colours; or |a - b| times `scale`; or a, b and that side by side, all three from
/// sRGB values over the background. Ignored pixels are grey in |a - b|.
void writeDifference(const std::string& path, const StoredImage& a, const StoredImage& b,
                     const CompareOptions& options, DifferenceKind kind, double scale);

}  // namespace glint
