#include "glint/image/picture_writer.h"

#include "glint/image/error.h"
#include "glint/image/file.h"
#include "glint/image/format_writers.h"

namespace glint {
namespace {

using Id = PictureFormat::Id;

const PictureFormat* formatOf(const std::string& path, const PictureOptions& options) {
  if (options.format) return options.format;
  return path == "-" ? &pictureFormat(Id::png) : pictureFormatOf(path);
}

}  // namespace

PictureWriter::PictureWriter(std::string path, int width, int height)
    : path_(std::move(path)), width_(width), height_(height) {}

void PictureWriter::write(const Image& rows) {
  if (rows.width != width_ || rows.height < 0 || rows.height > height_ - rowsWritten_ ||
      rows.values.size() != std::size_t(4) * rows.width * rows.height) {
    throw Error(printablePath(path_) + ": rows that do not fit the picture's size");
  }
  writeRows(rows);
  rowsWritten_ += rows.height;
}

void PictureWriter::finish() {
  if (rowsWritten_ != height_) {
    throw Error(printablePath(path_) + ": only " + std::to_string(rowsWritten_) + " of " +
                std::to_string(height_) + " rows were written");
  }
  finishFile();
}

void checkPictureName(const std::string& path, const PictureOptions& options) {
  const std::string name = printablePath(path);
  if (options.bitDepth != 8 && options.bitDepth != 16) {
    throw InputError(name + ": " + std::to_string(options.bitDepth) +
                     " bits per channel: give 8 or 16");
  }
  if (options.quality < 1 || options.quality > 100) {
    throw InputError(name + ": a quality of " + std::to_string(options.quality) +
                     ": give one from 1 to 100");
  }
  const PictureFormat* format = formatOf(path, options);
  if (format && format->isWritten) return;
  throw InputError(name + ": " +
                   (format ? std::string(format->name) + " cannot be written"
                           : "the extension is not that of a known format") +
                   ": use " + writtenEndings());
}

void detail::checkFormatSides(const std::string& path, int width, int height, int most,
                              const char* formatName) {
  if (width <= most && height <= most) return;
  throw InputError(printablePath(path) + ": " + formatName + " has at most " +
                   std::to_string(most) + " pixels per side: use " +
                   std::string(pictureFormat(Id::png).endings[0]));
}

std::unique_ptr<PictureWriter> openPictureWriter(const std::string& path, int width, int height,
                                                 const PictureOptions& options) {
  checkPictureName(path, options);
  if (width < 1 || height < 1) {
    throw InputError(printablePath(path) + ": a picture of " + std::to_string(width) + " x " +
                     std::to_string(height) + " pixels: give a width and a height of at least 1");
  }
  switch (formatOf(path, options)->id) {
    case Id::jpeg:
      return detail::openJpeg(path, width, height, options);
    case Id::webp:
      return detail::openWebp(path, width, height, options);
    case Id::exr:
      return detail::openExr(path, width, height, options);
    case Id::pfm:
      return detail::openPfm(path, width, height);
    case Id::raw:
      return detail::openRaw(path, width, height, options);
    default:
      return detail::openPng(path, width, height, options);
  }
}

}  // namespace glint
