#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <vector>

#include "glint/image/texture.h"
#include "glint/render/draw_list.h"
#include "glint/scene/scene.h"

namespace glint {

/// A texture's picture with the smaller levels, if a sampler reads them.
struct DecodedImage {
  ByteImage image;
  std::vector<ByteImage> mipLevels;
  bool hasNormalLengths = false;  ///< in the alpha of a normal map (normal_lengths.h)
};

/// By index in Scene::images.
using DecodedImages = std::map<int, DecodedImage>;

/// Textures are this long a side at most; longer ones are halved while they are read, so that every
/// way of drawing has the same ones. Today's drivers support that size.
inline constexpr int maxTextureSide = 16384;

/// Whether some material's sampler reads an image's smaller levels.
bool readsMipLevels(const Scene&, int image);

/// The most bytes that the textures of one model may take decoded, for the whole process; 0 for
/// the usual rule: 256 MiB, or 128 times their bytes in the file where that is more.
void limitDecoding(std::uint64_t bytes);

/// The limit in force, for pictures of so many bytes in their files.
std::uint64_t decodeLimit(std::uint64_t encoded);

/// Decodes the images that the look reads, in as many threads as there are processors. A broken one
/// becomes a warning of the scene and its materials lose the texture; of meshes whose materials
/// blend it finds out whether all texels that they show are opaque.
///
/// Their headers say how much they will take before anything is decoded. Where that is more than
/// the limit, textures that are larger than the look's picture can show (twice its longer side, and
/// 1024 at least) are halved while they are read, the largest first, with a warning; where that is
/// not enough, an InputError names the largest. Warns of texels of
/// the look's environment that are no light.
DecodedImages decodeImages(Scene&, const Look&);

/// The same of those that `present` says are not there yet, for a look that has changed. A normal
/// map may be there without the lengths of its normals, and the look need them.
using IsPresent = std::function<bool(int image, bool withNormalLengths)>;
DecodedImages decodeImages(Scene&, const Look&, const IsPresent& present);

/// Whether a look needs the lengths of an image's normals.
bool needsNormalLengths(const EncodedImage&, const Look&);

}  // namespace glint
