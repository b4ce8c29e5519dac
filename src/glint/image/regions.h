#pragma once

#include <vector>

#include "glint/image/compare.h"

namespace glint::detail {

/// Gathers differing pixels into regions: by tiles, of which those that touch are one region.
class Regions {
 public:
  Regions(int width, int height);
  void add(int x, int y, double difference);
  /// The regions so far, those of the largest sums first.
  std::vector<DifferingRegion> found() const;

 private:
  static constexpr int side = 8;  ///< of a tile
  int across_, down_;
  std::vector<DifferingRegion> tiles_;
};

}  // namespace glint::detail
