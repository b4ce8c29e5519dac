#pragma once

#include <cstddef>
#include <vector>

namespace glint::detail {

/// Half of a symmetric or antisymmetric filter: weights at 0, 1, 2, ...; those at negative indices
/// are equal, or of opposite sign.
using HalfFilter = std::vector<float>;

/// FLIP's filters for a given number of pixels per degree. All are separable, except that the
/// blue-yellow channel's is the sum of two separable ones.
struct FlipFilters {
  explicit FlipFilters(double pixelsPerDegree);

  HalfFilter luminance, redGreen, blueYellow[2];  ///< contrast sensitivity
  HalfFilter gaussian, edge, point;               ///< features; edge is antisymmetric
  int radius = 0;                                 ///< of the largest filter
};

/// Planes of one picture, filtered along x.
enum FlipPlane {
  luminancePlane,
  redGreenPlane,
  blueYellowPlane0,
  blueYellowPlane1,
  gaussianPlane,
  edgePlane,
  pointPlane,
  flipPlanes
};

/// Opponent colours of one row, luminance and chroma relative to white, with `radius` more values
/// at both ends that repeat the edge values (and a few more to fill whole vectors).
struct FlipRow {
  FlipRow(int width, int radius);
  std::size_t stride;
  std::vector<float> values;  ///< three channels of `stride`
};

/// Clamps a row of linear RGBA to [0, 1] and converts it.
void flipConvertRow(const float* rgba, int width, int radius, FlipRow& row);

constexpr int flipBlock = 64;  ///< pixels filtered and compared together

/// Filters the columns [begin, end) of a converted row along x into `flipPlanes` planes of `stride`
/// floats; whole vectors of 16 are written. `begin` is a multiple of flipBlock.
void flipFilterRow(const FlipFilters& filters, const FlipRow& row, int begin, int end,
                   float* planes, std::size_t stride);

/// Filters the columns [begin, end) along y and compares them. `reference` and `test` hold
/// 2 * radius + 1 pointers to the planes of the rows around the current one. Writes
/// errors[begin] to errors[end - 1].
void flipCompareRow(const FlipFilters& filters, const float* const* reference,
                    const float* const* test, int begin, int end, std::size_t stride,
                    float* errors);

}  // namespace glint::detail
