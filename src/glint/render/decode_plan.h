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
  int halvings = 0;  ///< how often its sides are halved while it is read

  int width() const;  ///< pixels, once halved
  int height() const;
  /// Bytes kept: four a pixel, and a third of that for the smaller levels.
  std::uint64_t kept() const;
  /// Bytes while it is being decoded: kept() and what the decoder or the levels need in addition.
  std::uint64_t atWork() const;
};

/// Halves textures longer than maxTextureSide and, while all of them take more than `limit` bytes,
/// those larger than `useful` pixels a side. Returns the warnings. Throws InputError if they still
/// exceed the limit, or if all of them in full size, or decoding a single one, would take more than
/// three times the limit.
std::vector<std::string> planDecoding(std::vector<DecodeJob>& jobs, std::uint64_t limit,
                                      int useful);

}  // namespace glint::detail
