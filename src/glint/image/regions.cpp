#include "glint/image/regions.h"

#include <algorithm>
#include <cmath>

namespace glint::detail {
namespace {

void join(DifferingRegion& all, const DifferingRegion& one) {
  if (all.pixels == 0) {
    all = one;
    return;
  }
  all.box = {std::min(all.box.left, one.box.left), std::min(all.box.top, one.box.top),
             std::max(all.box.right, one.box.right), std::max(all.box.bottom, one.box.bottom)};
  all.pixels += one.pixels;
  all.difference = std::max(all.difference, one.difference);
  all.sum += one.sum;
}

}  // namespace

Regions::Regions(int width, int height)
    : across_((width + side - 1) / side),
      down_((height + side - 1) / side),
      tiles_(std::size_t(across_) * std::size_t(down_)) {}

void Regions::add(int x, int y, double difference) {
  join(tiles_[std::size_t(y / side) * std::size_t(across_) + std::size_t(x / side)],
       {{x, y, x, y}, 1, difference, std::isfinite(difference) ? difference : 1});
}

std::vector<DifferingRegion> Regions::found() const {
  std::vector<DifferingRegion> regions;
  std::vector<char> seen(tiles_.size());
  std::vector<std::size_t> open;
  for (std::size_t first = 0; first < tiles_.size(); ++first) {
    if (seen[first] || tiles_[first].pixels == 0) continue;
    DifferingRegion region;
    seen[first] = 1;
    open.assign(1, first);
    while (!open.empty()) {
      const std::size_t tile = open.back();
      open.pop_back();
      join(region, tiles_[tile]);
      const int tx = int(tile % std::size_t(across_)), ty = int(tile / std::size_t(across_));
      for (int y = std::max(0, ty - 1); y <= std::min(down_ - 1, ty + 1); ++y)
        for (int x = std::max(0, tx - 1); x <= std::min(across_ - 1, tx + 1); ++x) {
          const std::size_t next = std::size_t(y) * std::size_t(across_) + std::size_t(x);
          if (seen[next] || tiles_[next].pixels == 0) continue;
          seen[next] = 1;
          open.push_back(next);
        }
    }
    regions.push_back(region);
  }
  std::stable_sort(regions.begin(), regions.end(),
                   [](const auto& a, const auto& b) { return a.sum > b.sum; });
  return regions;
}

}  // namespace glint::detail
