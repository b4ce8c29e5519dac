#include "thumbnails.h"

#include <utility>

#include "material_ball.h"
#include "presets.h"

namespace glint::viewer {

Thumbnails::Kept Thumbnails::kept(const Thumbnail& small) {
  Kept kept{TextureHandle::make(), small.width, small.height};
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, kept.texture.id());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, small.width, small.height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
               small.rgba.data());
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  return kept;
}

Thumbnails::Shown Thumbnails::shown(const Kept& kept) {
  return {kept.texture.id(), kept.width, kept.height};
}

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
    found = kept_.emplace(image, kept(small)).first;
  }
  return shown(found->second);
}

Thumbnails::Shown Thumbnails::ofPreset(int preset, const FitForm& form) {
  if (form.blinn != ballForm_.blinn || form.blinnFactor != ballForm_.blinnFactor) {
    balls_.clear();
    ballForm_ = form;
  }
  auto found = balls_.find(preset);
  if (found == balls_.end())
    found = balls_
                .emplace(preset,
                         kept(ballOf(presetParameters(presets()[std::size_t(preset)]), form, 48)))
                .first;
  return shown(found->second);
}

}  // namespace glint::viewer
