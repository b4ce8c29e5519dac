#pragma once

#include "glint/image/picture_writer.h"

namespace glint::detail {

std::unique_ptr<PictureWriter> openPng(const std::string& path, int width, int height,
                                       const PictureOptions& options);
std::unique_ptr<PictureWriter> openJpeg(const std::string& path, int width, int height,
                                        const PictureOptions& options);
std::unique_ptr<PictureWriter> openWebp(const std::string& path, int width, int height,
                                        const PictureOptions& options);
std::unique_ptr<PictureWriter> openExr(const std::string& path, int width, int height,
                                       const PictureOptions& options);
std::unique_ptr<PictureWriter> openPfm(const std::string& path, int width, int height);
std::unique_ptr<PictureWriter> openRaw(const std::string& path, int width, int height,
                                       const PictureOptions& options);

/// Throws InputError if a side is longer than the format allows.
void checkFormatSides(const std::string& path, int width, int height, int most,
                      const char* formatName);

}  // namespace glint::detail
