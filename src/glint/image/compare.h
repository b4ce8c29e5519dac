#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "glint/image/flip.h"
#include "glint/image/image.h"
#include "glint/image/stored_image.h"

namespace glint {

/// How a comparison treats a pixel's alpha.
enum class AlphaUse {
  straight,  ///< alpha is a fourth value; colour does not count where alpha is 0
  over,      ///< the picture is laid over CompareOptions::background
  ignored    ///< only the straight colours are compared
};

/// Which numbers are compared.
enum class ValueSpace {
  asStored,  ///< as in the files: sRGB codes in [0, 1], or linear light; Error if the two differ
  encoded,   ///< sRGB in [0, 1]
  linear     ///< linear light
};

/// A rectangle of pixels, both corners included.
struct PixelBox {
  int left = 0, top = 0, right = 0, bottom = 0;
};

/// A metric with its pass bound: at most `threshold`; for "psnr" and "ssim", at least.
struct Condition {
  std::string metric;
  double threshold = 0;
};

/// A limit on a number of pixels: a count, or a share of all pixels (of the counting window's, if
/// any).
struct PixelLimit {
  double most = 0;
  bool isShare = false;
};

/// The pixel distance that "pixels" compares with the tolerance: that of pixelmatch up to version 7
/// (YIQ) or that of version 8 (HyAB in OKLab with its lightness corrected near black).
enum class PixelDistance { yiq, oklab };

struct CompareOptions {
  std::vector<Condition> conditions;
  std::vector<std::string> metrics;   ///< computed in addition to those of the conditions
  std::vector<PixelLimit> maxPixels;  ///< limits on the pixels over the tolerance
  double tolerance = 0.1;             ///< for "pixels": [0, 1], pixelmatch's distance
  PixelDistance distance = PixelDistance::yiq;
  bool ignoreAntiAliasing = false;  ///< pixels that look like anti-aliasing are not counted
  int shift = 0;   ///< pixels found within this distance in the other picture are not counted
  int window = 0;  ///< for "pixels": the largest count in any window of this side; 0: whole picture
  AlphaUse alpha = AlphaUse::straight;
  std::array<float, 3> background{};  ///< linear light, for AlphaUse::over
  ValueSpace values = ValueSpace::asStored;
  std::vector<PixelBox> ignored;
  const StoredImage* mask = nullptr;  ///< of the same size; black (below half) is ignored
  std::size_t worst = 10;             ///< how many of the worst pixels are kept
  bool regions = false;               ///< whether to find the regions that differ
  FlipOptions flip;
  FlipRows flipMap;  ///< gets the rows of a FLIP map: "hdr-flip" if requested, else "flip"
};

struct WorstPixel {
  int x = 0, y = 0;
  std::array<float, 4> a{}, b{};  ///< the values compared
  double difference = 0;          ///< the largest over the channels
};

/// A cluster of differing pixels: gaps within it are at most 15 pixels.
struct DifferingRegion {
  PixelBox box;
  std::size_t pixels = 0;
  double difference = 0;  ///< the largest over channels and pixels
  double sum = 0;         ///< of each pixel's largest difference; a non-finite one counts as 1
};

/// The metrics' names, in the order in which they are reported. `max` to `psnr` use the values
/// compared; the others use what is visible: sRGB for `pixels` and `ssim`, linear light for FLIP.
/// In these, straight alpha is laid over black or, where the alphas differ and that shows more,
/// over white (`pixels` counts a pixel that differs over either).
///
///   max            largest absolute difference of a channel
///   mean           mean absolute difference over channels and pixels
///   rmse           root of the mean square difference
///   relative-rmse  root of the mean of (a - b)^2 / (a^2 + 0.01), a the baseline
///   psnr           -20 log10(rmse), dB; infinite for equal pictures
///   pixels         pixels over the tolerance
///   ssim           mean structural similarity of the luma (Wang, Bovik, Sheikh, Simoncelli 2004)
///   flip           mean LDR-FLIP
///   hdr-flip       mean HDR-FLIP
const std::vector<std::string>& metricNames();
/// Whether larger is better.
bool isSimilarity(const std::string& metric);

struct Comparison {
  bool same = false;                  ///< all conditions hold; without any: the pictures are equal
  std::vector<std::string> failures;  ///< one line for each condition that fails
  std::map<std::string, double> values;  ///< by metric
  FlipResult flip, hdrFlip;              ///< if requested
  std::size_t pixels = 0;                ///< compared
  std::size_t ignoredPixels = 0;         ///< ignored because of boxes and the mask
  std::size_t differing = 0;             ///< pixels with any difference at all
  std::size_t alphaDiffering = 0;        ///< pixels whose (straight) alphas differ
  bool seenOverWhite = false;            ///< ssim and FLIP over white, not black or background
  std::size_t antiAliased = 0;           ///< over the tolerance, but excluded as anti-aliasing
  std::size_t nanA = 0, nanB = 0, infinityA = 0, infinityB = 0;  ///< pixels
  std::size_t infinityDiffering = 0;  ///< pixels whose infinity the other picture does not have
  std::size_t aboveOne = 0;           ///< pixels that "flip" clamps because a colour is above 1
  bool sizesDiffer = false;           ///< if so, the values are for the padded pictures
  int width = 0, height = 0;          ///< of the area compared
  ValueSpace space = ValueSpace::encoded;  ///< of the values in `worst`
  std::vector<WorstPixel> worst;           ///< descending
  std::vector<DifferingRegion> regions;    ///< if requested, by descending sum

  /// The worst pixels with both values, one per line.
  std::string worstText() const;
};

/// Compares two pictures; A is the baseline. The same infinity in both counts as equal. Other
/// non-finite values are counted and left out of the metrics; they fail every comparison except a
/// test for equality (no condition), where the same NaN counts as equal. A metric with no values
/// left is NaN. Pictures of different sizes are never the same, whatever the conditions: one
/// failure reports the sizes, and the values are for both pictures padded with transparent pixels
/// at the right and at the bottom (if the padded size is at most 2^28 pixels; otherwise there are
/// no values). Throws InputError for unknown metrics, a mask of another size, and mismatched value
/// spaces.
Comparison compare(const StoredImage& a, const StoredImage& b, const CompareOptions& options = {});
/// The same for pictures in linear light.
Comparison compare(const Image& a, const Image& b, const CompareOptions& options = {});

/// `image` padded with transparent pixels at the right and at the bottom to the given size.
StoredImage padded(const StoredImage& image, int width, int height);

}  // namespace glint
