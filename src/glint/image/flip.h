#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "glint/image/pixel_rows.h"

namespace glint {

/// Pixels per degree for a screen viewed head-on: `distance` and `width` in the same unit, `pixels`
/// along that width. 0.7, 3840, 0.7 give FLIP's default, 67.0206.
double pixelsPerDegree(double distance, double pixels, double width);

/// The tone curves of HDR-FLIP. Reinhard's applies to luminance, x / (1 + x); the others to each
/// channel.
enum class ToneMapper { aces, hable, reinhard };

struct FlipOptions {
  double pixelsPerDegree = 67.02064327658226;  ///< (0, 1000]
  // For HDR-FLIP, in stops; if unset, derived from the reference.
  std::optional<double> startExposure, stopExposure;
  int exposures = 0;  ///< number of exposures tried; 0: one per stop
  ToneMapper toneMapper = ToneMapper::aces;
  int threads = 0;  ///< 0: as many as there are processors
};

/// The differences that FLIP perceives, 0 (none) to 1.
struct FlipResult {
  double mean = 0;         ///< over the pixels that count
  double maximum = 0;      ///< likewise
  std::size_t pixels = 0;  ///< number of pixels counted
  /// Quartiles weighted by the errors themselves: a quarter, a half and three quarters of the sum
  /// of all errors lie below them; to 1/65536.
  double firstQuartile = 0, median = 0, thirdQuartile = 0;
  // For HDR-FLIP: the exposures tried.
  double startExposure = 0, stopExposure = 0;
  int exposures = 0;
};

/// Takes rows of the error map, `width` values each, from the top and in order.
using FlipRows = std::function<void(int y, const float* errors)>;

/// LDR-FLIP (Andersson, Nilsson, Akenine-Moeller, Oskarsson, Astroem, Fairchild, "FLIP: A
/// Difference Evaluator for Alternating Images", HPG 2020) between a reference and a test picture
/// of the same size. Values are clamped to [0, 1] in linear light; alpha is ignored; beyond the
/// edges the nearest pixel is used. `counts(y, row)` fills a row with 1 for the pixels to be
/// averaged and 0 for the others; if empty, all count.
///
/// Arithmetic is in float, with tables and polynomials whose errors are below 1e-6 of the result;
/// sums are in double. The result is the same on every processor and for any number of threads.
FlipResult flip(const PixelRows& reference, const PixelRows& test, const FlipOptions& options = {},
                const FlipRows& map = {},
                const std::function<void(int y, unsigned char* row)>& counts = {});

/// HDR-FLIP (Andersson, Nilsson, Shirley, Akenine-Moeller, "Visualizing Errors in Rendered High
/// Dynamic Range Images", Eurographics 2021): the largest LDR-FLIP, after tone mapping, over
/// exposures that range from showing the reference's brightest pixel to showing its median one.
/// Keeps a map of floats. Throws InputError if the start is above the stop.
FlipResult hdrFlip(const PixelRows& reference, const PixelRows& test,
                   const FlipOptions& options = {}, const FlipRows& map = {},
                   const std::function<void(int y, unsigned char* row)>& counts = {});

/// The Magma colour for an error in [0, 1]: sRGB values from 0 to 255.
void magma(float error, unsigned char rgb[3]);

}  // namespace glint
