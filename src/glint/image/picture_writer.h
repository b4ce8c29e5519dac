#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "glint/image/image.h"
#include "glint/image/picture_format.h"

namespace glint {

struct PictureOptions {
  int bitDepth = 8;  ///< of PNG: 8 or 16
  int quality = 90;  ///< of JPEG and WebP, [1, 100]; at 100 a WebP is without loss
  /// PNG and WebP with straight, EXR and raw with premultiplied alpha; else over black.
  bool alpha = false;
  float exposureScale = 1;  ///< times the colours before encoding to sRGB; finite, positive
  const PictureFormat* format = nullptr;  ///< null: that of the path's ending
  /// Text chunks of a PNG, string attributes of an EXR: keyword (1 to 79 characters of ASCII, in
  /// an EXR not one of the format's own) and text (UTF-8).
  std::vector<std::pair<std::string, std::string>> text;
};

/// A picture file written in pieces, from the top. It appears when finish() has returned; destroyed
/// before that, it leaves nothing.
class PictureWriter {
 public:
  virtual ~PictureWriter() = default;
  PictureWriter(const PictureWriter&) = delete;
  PictureWriter& operator=(const PictureWriter&) = delete;

  /// The next rows, as many as `rows` has, as wide as the picture; copied or written on return.
  /// Throws InputError if the file cannot be written (perhaps only at a later call), Error if the
  /// rows do not fit the picture.
  void write(const Image& rows);

  /// Ends the file and puts it in its place, all rows having been written.
  void finish();

  /// The number of pixels written so far with a NaN in a colour (in PNG with alpha: or in alpha).
  std::size_t nanPixels() const { return nanPixels_; }

 protected:
  PictureWriter(std::string path, int width, int height);
  virtual void writeRows(const Image& rows) = 0;
  virtual void finishFile() = 0;

  const std::string path_;
  const int width_;
  const int height_;
  int rowsWritten_ = 0;  ///< before the current write()
  std::size_t nanPixels_ = 0;
};

/// Throws the InputErrors of openPictureWriter that need no file: wrong ending, wrong numbers.
void checkPictureName(const std::string& path, const PictureOptions& options);

/// Opens a picture of width x height pixels; the format is that of the options or of the path's
/// ending:
///
///     .png  sRGB (perceptual), 8 or 16 bits, RGB or RGBA
///     .jpg, .jpeg  sRGB, 8 bits, without alpha (the picture over black), at most 65500 pixels a
///           side; colours at full resolution from quality 90 on
///     .webp  sRGB, 8 bits, RGB or RGBA, at most 16383 pixels a side
///     .exr  32-bit float, linear, without exposure, scan lines in ZIP blocks; needs a regular file
///     .pfm  "PF", 32-bit float, little-endian, linear, without exposure and alpha (the picture
///           over black), bottom row first; needs a regular file
///     raw (by the options alone)  for programs: little-endian words of 32 bits: the letters
///           "GLNT", width, height, channels (3 or 4), then as many floats for each pixel, rows
///           from the top, linear, without exposure
///     "-"   to standard output, PNG unless the options say otherwise
///
/// Throws InputError for another ending, for sizes below 1 and for a file that cannot be made.
std::unique_ptr<PictureWriter> openPictureWriter(const std::string& path, int width, int height,
                                                 const PictureOptions& options = {});

}  // namespace glint
