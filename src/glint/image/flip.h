#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "glint/image/pixel_rows.h"

namespace glint {

/// Pixels per degree of a screen seen straight on: `distance` and `width` in one unit, `pixels`
/// along that width. 0.7, 3840, 0.7 give FLIP's default, 67.0206.
double pixelsPerDegree(double distance, double pixels, double width);

/// The curves of HDR-FLIP. Reinhard's is of the luminance, x / (1 + x); the others of each channel.
enum class ToneMapper { aces, hable, reinhard };

struct FlipOptions {
  double pixelsPerDegree = 67.02064327658226;  ///< (0, 1000]
  // Of HDR-FLIP: stops; what is not given comes from the reference.
  std::optional<double> startExposure, stopExposure;
  int exposures = 0;  ///< how many are tried; 0: one a stop
  ToneMapper toneMapper = ToneMapper::aces;
  int threads = 0;  ///< 0: as many as the processor has
};

/// The differences that FLIP sees, 0 (none) to 1.
struct FlipResult {
  double mean = 0;         ///< over the pixels that count
  double maximum = 0;      ///< likewise
  std::size_t pixels = 0;  ///< that count
  /// Weighted by themselves: the errors below which lie a quarter, a half and three quarters of
  /// the sum of all errors; to 1/65536.
  double firstQuartile = 0, median = 0, thirdQuartile = 0;
  // Of HDR-FLIP: the exposures tried.
  double startExposure = 0, stopExposure = 0;
  int exposures = 0;
};

/// Takes rows of the error map, `width` values each, from the top and in order.
using FlipRows = std::function<void(int y, const float* errors)>;

/// LDR-FLIP (Andersson, Nilsson, Akenine-Moeller, Oskarsson, Astroem, Fairchild, "FLIP: A
/// Difference Evaluator for Alternating Images", HPG 2020) between a reference and a test picture
/// of one size. Values are clamped to [0, 1] in linear light; alpha is not looked at; beyond the
/// edges the nearest pixel counts. `counts(y, row)` fills a row with 1 for the pixels that are
/// averaged and 0 for the others; empty: all count.
///
/// Arithmetic is in float with tables and polynomials whose errors are below 1e-6 of the result;
/// sums are in double. The same on every processor and for every number of threads.
FlipResult flip(const PixelRows& reference, const PixelRows& test, const FlipOptions& options = {},
                const FlipRows& map = {},
                const std::function<void(int y, unsigned char* row)>& counts = {});

/// HDR-FLIP (Andersson, Nilsson, Shirley, Akenine-Moeller, "Visualizing Errors in Rendered High
/// Dynamic Range Images", Eurographics 2021): the largest LDR-FLIP over exposures that show the
/// reference between its brightest and its median pixel, tone-mapped. Keeps a map of floats.
/// Throws InputError for a start that is above the stop.
FlipResult hdrFlip(const PixelRows& reference, const PixelRows& test,
                   const FlipOptions& options = {}, const FlipRows& map = {},
                   const std::function<void(int y, unsigned char* row)>& counts = {});

/// A colour of the Magma map for an error in [0, 1]: sRGB values of 0 to 255.
void magma(float error, unsigned char rgb[3]);

}  // namespace glint
