#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "glint/image/texture.h"

namespace glint::detail {

/// One texture that will be decoded.
struct DecodeJob {
  int image = 0;  ///< in Scene::images
  std::string name;
  TextureHeader header;
  std::uint64_t encoded = 0;  ///< bytes in the file
  bool hasLevels = false;     ///< the smaller levels are made too
  bool needsNormalLengths = false;
  int halvings = 0;  ///< of its sides, while it is read

  int width() const;  ///< pixels, once halved
  int height() const;
  /// Bytes that are kept: four a pixel, and a third of that for the smaller levels.
  std::uint64_t kept() const;
  /// Bytes while it is being decoded: those and what the decoder and the levels need beside them.
  std::uint64_t atWork() const;
};

/// Halves what is longer than maxTextureSide, and where all takes more than `limit` bytes what is
/// larger than `useful` pixels a side. Gives the warnings. Throws InputError where it is still
/// more, or where three times as much would have to be read for it or is needed to decode one
/// alone.
std::vector<std::string> planDecoding(std::vector<DecodeJob>& jobs, std::uint64_t limit,
                                      int useful);

}  // namespace glint::detail
