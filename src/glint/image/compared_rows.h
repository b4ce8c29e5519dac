#pragma once

#include <vector>

#include "glint/image/compare.h"

namespace glint::detail {

/// "the sizes differ: ..."
std::string sizesText(const StoredImage& a, const StoredImage& b);

/// What shows behind transparent pixels: linear light.
using Background = std::array<float, 3>;

/// Two pictures as a comparison sees them: alpha resolved, in the requested value space, and with
/// ignored pixels made equal to the baseline so that they cannot affect their neighbours through a
/// filter.
class ComparedRows {
 public:
  /// Throws Error for different sizes, InputError for anything else that prevents a comparison.
  ComparedRows(const StoredImage& a, const StoredImage& b, const CompareOptions& options);

  int width() const { return a_.width; }
  int height() const { return a_.height; }
  int channels() const { return channels_; }  ///< channels compared: 3 or 4
  ValueSpace space() const { return space_; }

  /// Whether the 8-bit codes of both are compared unchanged, with the same number of channels.
  bool comparesCodes() const { return comparesCodes_; }
  int codeChannels() const { return a_.channels; }
  /// Row y of each; `copy` holds it for a picture that is read by rows.
  const std::uint8_t* codesA(int y, std::vector<std::uint8_t>& copy) const {
    return a_.heldRows(y, 1, copy);
  }
  const std::uint8_t* codesB(int y, std::vector<std::uint8_t>& copy) const {
    return b_.heldRows(y, 1, copy);
  }
  /// The values to compare for one pixel's codes.
  void valuesOf(const std::uint8_t* codes, float* values) const;
  /// Whether all codes of a row are the same in both (of 16 bits too).
  bool codesAreEqual(int y) const;
  /// Pixels with a colour above 1 in linear light in either picture; always 0 for codes.
  std::size_t pixelsAboveOne() const;

  /// Row y of both in the requested value space: 4 * width values each.
  void values(int y, float* a, float* b) const;
  /// In sRGB over the background, opaque.
  void encoded(int y, float* a, float* b) const;
  void showOver(const Background& background) { background_ = background; }
  /// 1 for pixels that count, 0 for ignored ones.
  void counted(int y, unsigned char* row) const;
  bool ignoresSome() const { return ignoresSome_; }

  /// Linear light over the background, for FLIP.
  PixelRows linearA() const;
  PixelRows linearB() const;

 private:
  int reach() const;  ///< see PixelRows
  void rowOf(const StoredImage& image, int y, ValueSpace space, AlphaUse alpha, float* rgba) const;
  void pair(int y, ValueSpace space, AlphaUse alpha, float* a, float* b) const;

  const StoredImage& a_;
  const StoredImage& b_;
  const CompareOptions& options_;
  ValueSpace space_;
  Background background_;
  int channels_ = 3;
  bool ignoresSome_ = false;
  bool comparesCodes_ = false;
  bool bothCodes_ = false;
};

/// Mean structural similarity (Wang et al. 2004): 11 x 11 Gaussian of 1.5 pixels, K1 = 0.01,
/// K2 = 0.03, values in [0, 1], over the windows that lie entirely in the picture. If a side is
/// shorter than 11 pixels, the window is as long as that side. Windows centred on ignored pixels
/// are left out.
double structuralSimilarity(const ComparedRows& rows);

/// Counts the pixels that differ by more than a tolerance, as pixelmatch does: the distance in YIQ
/// (Kotsarenko and Ramos 2010) or by HyAB (Abasi, Tehran, Fairchild 2019) in OKLab (Ottosson 2020)
/// with its lightness corrected near black; anti-aliasing by Vysniauskas (2009). Given several
/// views of the pictures, a pixel differs if it differs in any of them.
struct PixelCount {
  std::size_t over = 0, antiAliased = 0;
};
PixelCount countPixels(const std::vector<const ComparedRows*>& views,
                       const CompareOptions& options);

}  // namespace glint::detail
