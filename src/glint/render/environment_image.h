#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

#include "glint/scene/look.h"

namespace glint {

/// A picture of all directions, with smaller levels for wider views.
///
/// Equirectangular, +Y up, -Z in its middle: the direction (x, y, z) is seen at
/// u = 1/2 + atan2(x, -z) / 2 pi from the left and v = acos(y) / pi from the top.
///
/// A level is half as high and wide as the one before (rounded down), each texel the mean of the
/// light from the part of the sphere it covers. From level 1 on a texel is also widened along its
/// row until it covers as large an angle there as vertically: towards the poles, where texels
/// crowd, rows would otherwise hold detail finer than the level stands for. A row keeps its first
/// harmonic, by which a radiance that is linear in direction goes around a pole (as the mean over
/// the rows that it stands for); the row nearest to a pole is left with that and its mean, so that
/// the pole is smooth.
struct EnvironmentImage {
  struct Level {
    int width = 0, height = 0;
    std::vector<float> rgb;  ///< linear radiance, rows from the top, finite and not negative
  };
  std::string name;  ///< the file, for messages
  /// Texels with a value that was no number, infinite or negative, and counts as below.
  std::size_t corrected = 0;
  std::vector<Level> levels;

  /// Which level shows the mean over a square of `spread` radians: log2(spread height / (sqrt(3)
  /// pi)), at least 0; between two levels it is interpolated. The bilinear look-up of texels of the
  /// height h, each a mean itself, has the variance h^2 / 12 + h^2 / 6 over all places, and the
  /// square has s^2 / 12: they agree at h = s / sqrt(3), and so do the means of what is linear or
  /// quadratic in direction, to the second order.
  double levelFor(double spread) const;

  /// The radiance from a direction of any length but 0, world space, as the mean over about
  /// `spread` radians: bilinear within a level (beyond the row nearest to a pole lies that of the
  /// pole's other side), linear between levels.
  glm::dvec3 radiance(const glm::dvec3& direction, double spread) const;
};

/// Makes the levels. `rgb` is width * height * 3 values; NaN and negative ones count as 0, those
/// above 1e30 as 1e30, and the texels that have them (negative, NaN, infinite) are counted.
EnvironmentImage makeEnvironmentImage(int width, int height, std::vector<float> rgb);

/// The picture that a look's `hdriFile` names, or none where the look shows no environment. Any
/// format of readImage(). The last one read is kept, as long as the file does not change. Throws
/// InputError "--hdri-file: FILE: what: what to do", also where the picture's header tells that it
/// would take more than three times decodeLimit() as floats, 16 bytes a pixel.
std::shared_ptr<const EnvironmentImage> environmentImageFor(const Look&);

}  // namespace glint
