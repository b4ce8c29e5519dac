#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "glint/image/image.h"
#include "glint/reference/scene.h"
#include "glint/study/scene.h"

namespace glint {

/// The inputs of a driver's shaders at a pixel.
struct DriverInput {
  glm::vec3 position{0.0f}, normal{0.0f}, emission{0.0f};
  glm::vec4 base{1.0f};
  bool front = true;
};

/// The pixels at which pictures are compared: those where the driver and the reference show the
/// same surface, away from edges. All programs draw the same surface, so one mask serves all.
struct StudyMask {
  std::vector<std::uint32_t> pixels;  ///< y * width + x, ascending
  std::vector<DriverInput> inputs;    ///< of the same pixels

  std::size_t covered = 0;     ///< pixels that the driver or the reference covers; of them:
  std::size_t onlyOne = 0;     ///< covered by only one of them: the error of rasterisation
  double onlyOneEdge = 0;      ///< the largest distance of those from an edge, pixels
  std::size_t edge = 0;        ///< next to an uncovered pixel, or within 1/256 of a triangle's edge
  std::size_t other = 0;       ///< that show another surface, or something blended
  bool sampledColors = false;  ///< there are textures: the driver's own samples are used
};

StudyMask maskOf(Renderer& renderer, GpuScene& gpu, const StudyScene& scene, const Look& look);

/// Radiance in double at the pixels of a mask.
using Radiances = std::vector<glm::dvec3>;

/// The exact form of a program at the mask's pixels, from what the reference interpolates, but with
/// the driver's samples of textures if there are any; a mapped normal is the driver's. With
/// `atInputs` at the positions and normals that the driver interpolated; only for per-pixel
/// programs.
Radiances truthOf(const StudyScene& scene, const Look& look, Shading program, const StudyMask& mask,
                  bool atInputs = false);

/// A picture's radiance at the mask's pixels.
Radiances radiancesOf(const Image& picture, const StudyMask& mask);

/// Differences over a mask, in linear light before exposure.
struct PictureError {
  double max = 0;
  double percentile999 = 0;  ///< 99.9th of each pixel's largest difference
  double rmse = 0;           ///< over pixels and channels
  double relativeRmse = 0;   ///< rmse over the root mean square of the truth; 0 if that is 0
  double offByMore = 0;      ///< share of pixels with a code off by more than one level, 8-bit sRGB
  int levels = 0;            ///< the largest difference of codes
};

/// The difference of a NaN is infinite.
PictureError errorOf(const Radiances& truth, const Radiances& drawn, double exposureScale = 1);

/// Mean LDR-FLIP over the mask; outside of it the pictures are made equal.
double flipOf(const Image& picture, const StudyMask& mask, const Radiances& truth,
              const glm::dvec3& background, double exposureScale);

/// The picture over a background, opaque; `at`, if given, replaces its pixels in the mask.
Image overBackground(const Image& picture, const glm::dvec3& background, const StudyMask& mask,
                     const Radiances* at = nullptr);

}  // namespace glint
