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

/// The longest side of a texture, in pixels. Longer ones are halved while they are read, so that
/// every renderer has the same texels. Today's drivers support this size.
inline constexpr int maxTextureSide = 16384;

/// Whether some material's sampler reads an image's smaller levels.
bool readsMipLevels(const Scene&, int image);

/// Sets, for the whole process, the most bytes that the decoded textures of one model may take; 0
/// restores the default: 256 MiB or 128 times their bytes in the file, whichever is more.
void limitDecoding(std::uint64_t bytes);

/// The limit in force for pictures that take `encoded` bytes in their files.
std::uint64_t decodeLimit(std::uint64_t encoded);

/// Decodes the images that the look reads, on as many threads as there are processors. A broken one
/// becomes a warning of the scene, and its materials lose the texture. Sets Mesh::opaqueTexels of
/// meshes whose materials blend: whether all texels that they show are opaque.
///
/// The images' headers give the memory needed before anything is decoded. If it exceeds the limit,
/// textures larger than the look's picture can show (twice its longer side, at least 1024) are
/// halved while they are read, the largest first, with a warning. If that is not enough, an
/// InputError names the largest. Also warns of texels of the look's environment that are negative,
/// infinite or NaN.
DecodedImages decodeImages(Scene&, const Look&);

/// The same for the images that are not `present` yet, after the look has changed. A normal map may
/// be present without the lengths of its normals that the look needs.
using IsPresent = std::function<bool(int image, bool withNormalLengths)>;
DecodedImages decodeImages(Scene&, const Look&, const IsPresent& present);

/// Whether a look needs the lengths of an image's normals.
bool needsNormalLengths(const EncodedImage&, const Look&);

}  // namespace glint
