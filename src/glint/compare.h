#pragma once

// Comparison of pictures for other programs: `glint diff` as functions. glint/image/compare.h has
// every option of it; glint/image/matchers.h has matchers for GoogleTest, which take Image as it
// comes from a Session:
//
//     EXPECT_THAT(session.draw(model), glint::MatchesBaseline("teapot.png", {{"flip", 0.01}}));
//
// All may be called from any thread.

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "glint/glint.h"
#include "glint/image/image.h"

namespace glint {

struct CompareRules {
  /// Metrics with their limits, all of which must hold: max, mean, rmse, relative-rmse, psnr,
  /// pixels, ssim, flip, hdr-flip (docs/image-tests.md; psnr and ssim: at least, others: at most).
  /// Without any the pictures must be equal.
  std::vector<std::pair<std::string, double>> limits = {};
  std::vector<std::string> metrics = {};  ///< to be reported beside those
  double tolerance = 0.1;                 ///< of "pixels": pixelmatch's threshold, [0, 1]
  bool ignoreAlpha = false;
};

struct Differences {
  bool same = false;
  std::map<std::string, double> values;  ///< by metric; NaN where nothing could be compared
  std::vector<std::string> failures;     ///< one line for each limit that does not hold
  std::string worst;                     ///< the pixels that differ most, a line each
  /// The error that FLIP sees, [0, 1], one float a pixel, rows from the top; empty unless "flip" is
  /// among the metrics and the sizes agree.
  std::vector<float> map;
  int width = 0, height = 0;  ///< of what was compared, pixels
};

/// `a` is the baseline. Pictures of different sizes are not the same. Throws InputError for a
/// metric that there is not.
Differences comparePictures(const Image& a, const Image& b, const CompareRules& rules = {});
Differences comparePictures(const Codes& a, const Codes& b, const CompareRules& rules = {});
/// Of files: PNG, EXR, PFM, HDR, JPEG, WebP, TIFF and others, as they are stored. Throws InputError
/// for what cannot be read.
Differences compareFiles(const std::string& a, const std::string& b,
                         const CompareRules& rules = {});

/// The codes of a picture in linear light, its colours times `scale` (2 to the power of exposure).
Codes encoded(const Image& picture, float scale = 1);

/// Reads a picture to linear light, colours premultiplied by alpha. Throws InputError.
Image readPicture(const std::string& path);
/// Writes one, by its ending: .png, .jpg, .webp (sRGB, 8 bits), .exr, .pfm (linear float); whole or
/// not at all. Throws InputError.
void writePicture(const std::string& path, const Image& picture);
void writePicture(const std::string& path, const Codes& picture);

}  // namespace glint
