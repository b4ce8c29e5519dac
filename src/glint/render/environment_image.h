#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

#include "glint/scene/look.h"

namespace glint {

/// A picture of the light from all directions, with smaller levels for means over wider angles.
///
/// Equirectangular, +Y up, -Z in its middle: the direction (x, y, z) is seen at
/// u = 1/2 + atan2(x, -z) / 2 pi from the left and v = acos(y) / pi from the top.
///
/// A level is half as high and wide as the one before (rounded down), each texel the mean of the
/// light from the part of the sphere it covers. From level 1 on a texel is also widened along its
/// row until it covers as large an angle there as vertically: towards the poles, where texels
/// crowd, rows would otherwise hold finer detail than the level has vertically. A row keeps its
/// first harmonic (the mean of those of the rows that it covers), since that is how a radiance that
/// is linear in direction varies around a pole. The row nearest to a pole keeps only that and its
/// mean, so that the pole is smooth.
struct EnvironmentImage {
  struct Level {
    int width = 0, height = 0;
    std::vector<float> rgb;  ///< linear radiance, rows from the top, finite and not negative
  };
  std::string name;  ///< the file, for messages
  /// Texels with a value that was NaN, infinite or negative; makeEnvironmentImage() replaces those.
  std::size_t corrected = 0;
  std::vector<Level> levels;

  /// The level that shows the mean over a square of `spread` radians: log2(spread height / (sqrt(3)
  /// pi)), at least 0; a fraction interpolates between two levels. A bilinear look-up in texels of
  /// height h, each a mean itself, has the variance h^2 / 12 + h^2 / 6 over all places, a square of
  /// side s has s^2 / 12. They agree at h = s / sqrt(3), and so do the means of what is linear or
  /// quadratic in direction, to second order.
  double levelFor(double spread) const;

  /// The radiance from a direction (world space, any length except 0), as the mean over about
  /// `spread` radians: bilinear within a level (beyond the row nearest to a pole comes the same row
  /// on the pole's other side), linear between levels.
  glm::dvec3 radiance(const glm::dvec3& direction, double spread) const;
};

/// Makes the levels. `rgb` is width * height * 3 values; NaN and negative values count as 0, values
/// above 1e30 as 1e30; `corrected` counts the texels with negative, NaN or infinite values.
EnvironmentImage makeEnvironmentImage(int width, int height, std::vector<float> rgb);

/// The picture that a look's `hdriFile` names, or none where the look shows no environment. Any
/// format of readImage(). The last picture read is cached while its file does not change. Throws
/// InputError "--hdri-file: FILE: what: what to do", also if the picture's header shows that it
/// would take more than three times decodeLimit() as floats, 16 bytes a pixel.
std::shared_ptr<const EnvironmentImage> environmentImageFor(const Look&);

}  // namespace glint
