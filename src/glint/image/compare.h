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

/// What a pixel's alpha means to a comparison.
enum class AlphaUse {
  straight,  ///< alpha is a fourth value; the colour where it is 0 does not count
  over,      ///< the picture is laid over CompareOptions::background
  ignored    ///< the straight colours alone
};

/// Which numbers are compared.
enum class ValueSpace {
  asStored,  ///< both pictures' own: sRGB codes in [0, 1], or linear light; Error if they differ
  encoded,   ///< sRGB in [0, 1]
  linear     ///< linear light
};

/// A rectangle of pixels, both corners included.
struct PixelBox {
  int left = 0, top = 0, right = 0, bottom = 0;
};

/// A metric with the bound that decides: at most `threshold`, of "psnr" and "ssim" at least.
struct Condition {
  std::string metric;
  double threshold = 0;
};

/// At most so many pixels: a number, or a share of all (of the window that is counted in).
struct PixelLimit {
  double most = 0;
  bool isShare = false;
};

/// What "pixels" holds against the tolerance: the distance of pixelmatch to version 7 (YIQ) or
/// that of version 8 (HyAB in OKLab with its lightness corrected near black).
enum class PixelDistance { yiq, oklab };

struct CompareOptions {
  std::vector<Condition> conditions;
  std::vector<std::string> metrics;   ///< to be computed beside those of the conditions
  std::vector<PixelLimit> maxPixels;  ///< at most so many pixels may be over the tolerance
  double tolerance = 0.1;             ///< of "pixels": [0, 1], distance of pixelmatch
  PixelDistance distance = PixelDistance::yiq;
  bool ignoreAntiAliasing = false;  ///< pixels that look like anti-aliasing are not counted
  int shift = 0;   ///< pixels that are found so far away in the other picture are not counted
  int window = 0;  ///< of "pixels": the largest count of a window of this side; 0: of the picture
  AlphaUse alpha = AlphaUse::straight;
  std::array<float, 3> background{};  ///< linear light, for AlphaUse::over
  ValueSpace values = ValueSpace::asStored;
  std::vector<PixelBox> ignored;
  const StoredImage* mask = nullptr;  ///< of the same size; black (below half) is ignored
  std::size_t worst = 10;             ///< how many of the worst pixels are kept
  bool regions = false;               ///< whether the regions that differ are told apart
  FlipOptions flip;
  FlipRows flipMap;  ///< takes the rows of the map of "hdr-flip" if that is asked for, or "flip"
};

struct WorstPixel {
  int x = 0, y = 0;
  std::array<float, 4> a{}, b{};  ///< the values compared
  double difference = 0;          ///< the largest over the channels
};

/// Differing pixels that lie together: no more than 15 pixels between them.
struct DifferingRegion {
  PixelBox box;
  std::size_t pixels = 0;
  double difference = 0;  ///< the largest over channels and pixels
  double sum = 0;         ///< of the largest of each pixel; not finite ones count as 1
};

/// The metrics' names, in the order in which they are reported. max to psnr are of the values
/// compared; the others are of what is seen: sRGB for pixels and ssim, linear light for FLIP, of
/// straight alpha over black or, where the alphas differ and that shows more, over white (`pixels`
/// counts a pixel that differs over either).
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
  std::vector<std::string> failures;  ///< one line for each condition that does not hold
  std::map<std::string, double> values;  ///< by metric
  FlipResult flip, hdrFlip;              ///< where asked for
  std::size_t pixels = 0;                ///< that were compared
  std::size_t ignoredPixels = 0;         ///< by boxes and mask
  std::size_t differing = 0;             ///< pixels with any difference at all
  std::size_t alphaDiffering = 0;        ///< pixels whose (straight) alphas differ
  bool seenOverWhite = false;            ///< by ssim and FLIP; else over black or the background
  std::size_t antiAliased = 0;           ///< over the tolerance, but left out as anti-aliasing
  std::size_t nanA = 0, nanB = 0, infinityA = 0, infinityB = 0;  ///< pixels
  std::size_t infinityDiffering = 0;  ///< pixels with an infinity that the other has not
  std::size_t aboveOne = 0;           ///< pixels that "flip" clamps: a colour is above 1
  bool sizesDiffer = false;           ///< values are then of both, padded with transparent pixels
  int width = 0, height = 0;          ///< of what was compared
  ValueSpace space = ValueSpace::encoded;  ///< of the values below
  std::vector<WorstPixel> worst;           ///< descending
  std::vector<DifferingRegion> regions;    ///< if asked for, those of the largest sums first

  /// The worst pixels with both values, a line each.
  std::string worstText() const;
};

/// Compares two pictures, A being the baseline. The same infinity in both is equal. Other values
/// that are not finite are counted and left out of the metrics; they fail every comparison but the
/// one that asks for equality (no condition), where the same NaN is equal. Metrics of which no
/// value is left are NaN. Pictures of different sizes are not the same, whatever the conditions:
/// one failure says so, and the values are of both pictures padded with transparent pixels at their
/// right and lower ends (if that has at most 2^28 pixels; else there are none).
/// Throws InputError for unknown metrics, a mask of another size, and value spaces that do not
/// match.
Comparison compare(const StoredImage& a, const StoredImage& b, const CompareOptions& options = {});
/// The same for pictures in linear light.
Comparison compare(const Image& a, const Image& b, const CompareOptions& options = {});

/// `image` with transparent pixels at its right and lower ends, as wide and high as is said.
StoredImage padded(const StoredImage& image, int width, int height);

}  // namespace glint
