#include "glint/image/picture_writer.h"

#include <cctype>

#include "glint/image/error.h"
#include "glint/image/file.h"
#include "glint/image/picture_formats.h"

namespace glint {
namespace {

/// The ending of the file's name in lower case, with its dot; empty if there is none.
std::string endingOf(const std::string& path) {
  const auto dot = path.find_last_of("./");
  if (dot == std::string::npos || path[dot] != '.') return "";
  std::string ending = path.substr(dot);
  for (char& letter : ending) {
    letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  }
  return ending;
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
  const std::string name = printablePath(path), ending = endingOf(path);
  if (options.bitDepth != 8 && options.bitDepth != 16) {
    throw InputError(name + ": " + std::to_string(options.bitDepth) +
                     " bits per channel: give 8 or 16");
  }
  if (path == "-" || ending == ".png" || ending == ".pfm" || ending == ".exr") return;
  throw InputError(name + ": the ending tells no known format: use .png, .exr or .pfm");
}

std::unique_ptr<PictureWriter> openPictureWriter(const std::string& path, int width, int height,
                                                 const PictureOptions& options) {
  checkPictureName(path, options);
  if (width < 1 || height < 1) {
    throw InputError(printablePath(path) + ": a picture of " + std::to_string(width) + " x " +
                     std::to_string(height) + " pixels: give a width and a height of at least 1");
  }
  if (endingOf(path) == ".pfm") return detail::openPfm(path, width, height);
  if (endingOf(path) == ".exr") return detail::openExr(path, width, height, options);
  return detail::openPng(path, width, height, options);
}

}  // namespace glint
