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
  int bitDepth = 8;  ///< PNG: 8 or 16
  int quality = 90;  ///< JPEG and WebP, [1, 100]; a WebP at 100 is lossless
  /// PNG and WebP with straight alpha, EXR and raw with premultiplied; if false, over black.
  bool alpha = false;
  float exposureScale = 1;  ///< multiplies the colours before encoding to sRGB; finite, positive
  const PictureFormat* format = nullptr;  ///< null: chosen by the path's extension
  /// Text chunks in a PNG, string attributes in an EXR: keyword (1 to 79 ASCII characters; in an
  /// EXR not one of the format's own) and text (UTF-8).
  std::vector<std::pair<std::string, std::string>> text;
};

/// A picture file written in pieces, from the top. It appears when finish() returns; destroyed
/// before that, it leaves nothing behind.
class PictureWriter {
 public:
  virtual ~PictureWriter() = default;
  PictureWriter(const PictureWriter&) = delete;
  PictureWriter& operator=(const PictureWriter&) = delete;

  /// Writes the next rows.height rows; `rows` must be as wide as the picture, and has been copied
  /// or written on return. Throws InputError if the file cannot be written (perhaps only in a later
  /// call), Error if the rows do not fit the picture.
  void write(const Image& rows);

  /// Completes the file and puts it in its place; all rows must have been written.
  void finish();

  /// The number of pixels so far with a NaN in a colour (for PNG with alpha, or in alpha).
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

/// Throws openPictureWriter's InputErrors that need no file: wrong extension, numbers out of range.
void checkPictureName(const std::string& path, const PictureOptions& options);

/// Opens a picture of width x height pixels; the options or the path's extension determine the
/// format:
///
///     .png  sRGB (perceptual), 8 or 16 bits, RGB or RGBA
///     .jpg, .jpeg  sRGB, 8 bits, no alpha (the picture over black), at most 65500 pixels a side;
///           chroma at full resolution from quality 90 up
///     .webp  sRGB, 8 bits, RGB or RGBA, at most 16383 pixels a side
///     .exr  32-bit float, linear, without exposure, scan lines in ZIP blocks; needs a regular file
///     .pfm  "PF", 32-bit float, little-endian, linear, without exposure and alpha (the picture
///           over black), bottom row first; needs a regular file
///     raw (only through the options)  for programs: little-endian 32-bit words: the letters
///           "GLNT", width, height, channels (3 or 4), then that many floats per pixel, rows
///           from the top, linear, without exposure
///     "-"   standard output, PNG unless the options say otherwise
///
/// Throws InputError for other extensions, for sizes below 1 and for a file that cannot be created.
std::unique_ptr<PictureWriter> openPictureWriter(const std::string& path, int width, int height,
                                                 const PictureOptions& options = {});

}  // namespace glint
