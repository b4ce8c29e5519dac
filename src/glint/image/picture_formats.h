#pragma once

#include "glint/image/picture_writer.h"

namespace glint::detail {

std::unique_ptr<PictureWriter> openPng(const std::string& path, int width, int height,
                                       const PictureOptions& options);
std::unique_ptr<PictureWriter> openExr(const std::string& path, int width, int height,
                                       const PictureOptions& options);
std::unique_ptr<PictureWriter> openPfm(const std::string& path, int width, int height);

}  // namespace glint::detail
