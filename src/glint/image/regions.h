#pragma once

#include <vector>

#include "glint/image/compare.h"

namespace glint::detail {

/// Groups differing pixels into regions: by tiles, where tiles that touch form one region.
class Regions {
 public:
  Regions(int width, int height);
  void add(int x, int y, double difference);
  /// The regions so far, by descending sum.
  std::vector<DifferingRegion> found() const;

 private:
  static constexpr int side = 8;  ///< of a tile, in pixels
  int across_, down_;
  std::vector<DifferingRegion> tiles_;
};

}  // namespace glint::detail
