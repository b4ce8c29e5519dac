#pragma once

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
};

/// By index in Scene::images.
using DecodedImages = std::map<int, DecodedImage>;

/// Decodes the images that the look reads, in parallel. A broken one becomes a warning of the scene
/// and its materials lose the texture; of meshes whose materials blend it finds out whether all
/// texels that they show are opaque. Warns of texels of the look's environment that are no light.
DecodedImages decodeImages(Scene&, const Look&);

/// The same of those that `present` says are not there yet, for a look that has changed.
DecodedImages decodeImages(Scene&, const Look&, const std::function<bool(int image)>& present);

}  // namespace glint
