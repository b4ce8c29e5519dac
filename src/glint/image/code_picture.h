#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "glint/image/file.h"
#include "glint/image/picture_writer.h"

namespace glint::detail {

/// A picture of 8-bit sRGB codes, written row by row, that is mostly even, as differences are. A
/// PNG that is not large is held and packed in one piece, which takes a third of the time. Formats
/// and errors are those of openPictureWriter().
class CodePicture {
 public:
  CodePicture(const std::string& path, int width, int height);

  /// The next row: 3 * width codes.
  void add(std::span<const std::uint8_t> rgb);
  void addBlack();
  void finish();

 private:
  std::uint8_t* held(int y) const;

  const int width_, height_;
  int y_ = 0;
  std::unique_ptr<std::uint8_t[], void (*)(void*)> rows_;  ///< each behind the number of its filter
  std::optional<OutputFile> file_;                         ///< of what is held
  std::unique_ptr<PictureWriter> writer_;                  ///< of everything else
};

}  // namespace glint::detail
