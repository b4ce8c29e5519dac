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

/// A picture of 8-bit sRGB codes, written row by row, that is mostly uniform, as differences are. A
/// PNG that is not large is held in memory and compressed in one piece, which takes a third of the
/// time. Formats and errors are those of openPictureWriter().
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
  std::unique_ptr<std::uint8_t[], void (*)(void*)> rows_;  ///< each row follows its filter byte
  std::optional<OutputFile> file_;                         ///< used if the picture is held
  std::unique_ptr<PictureWriter> writer_;                  ///< used otherwise
};

}  // namespace glint::detail
