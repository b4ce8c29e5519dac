#include "thumbnails.h"

#include <utility>

#include "material_textures.h"

namespace glint::viewer {

Thumbnails::Shown Thumbnails::of(const std::shared_ptr<const DecodedImages>& images, int image) {
  if (images != images_) {
    kept_.clear();
    images_ = images;
  }
  if (!images) return {};
  auto found = kept_.find(image);
  if (found == kept_.end()) {
    const auto decoded = images->find(image);
    if (decoded == images->end()) return {};
    const Thumbnail small = thumbnailOf(decoded->second.image, 64);
    if (small.rgba.empty()) return {};
    Kept kept{TextureHandle::make(), small.width, small.height};
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, kept.texture.id());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, small.width, small.height, 0, GL_RGBA,
                 GL_UNSIGNED_BYTE, small.rgba.data());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    found = kept_.emplace(image, std::move(kept)).first;
  }
  return {found->second.texture.id(), found->second.width, found->second.height};
}

}  // namespace glint::viewer
