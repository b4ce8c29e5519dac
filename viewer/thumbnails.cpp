#include "thumbnails.h"

#include <algorithm>
#include <utility>

#include "glint/image/srgb.h"
#include "material_ball.h"
#include "materials.h"
#include "presets.h"

namespace glint::viewer {
namespace {

bool sameBall(const ShadingParameters& a, const ShadingParameters& b) {
  return a.color == b.color && std::ranges::all_of(materialParameters(), [&](const auto& p) {
           return a.*p.value == b.*p.value;
         });
}

}  // namespace

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

void Thumbnails::keepTo(const std::shared_ptr<const DecodedImages>& images) {
  if (images == images_) return;
  kept_.clear();
  means_.clear();
  images_ = images;
}

glm::dvec3 Thumbnails::meanOf(int image) {
  const auto found = means_.find(image);
  if (found != means_.end()) return found->second;
  glm::dvec3 mean(1.0);
  const auto decoded = images_ ? images_->find(image) : DecodedImages::const_iterator();
  if (images_ && decoded != images_->end()) {
    const Thumbnail small = thumbnailOf(decoded->second.image, 16);
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i + 3 < small.rgba.size(); i += 4)
      for (int c = 0; c < 3; ++c) sum[c] += double(srgbDecoded[small.rgba[i + std::size_t(c)]]);
    if (!small.rgba.empty()) mean = sum / (double(small.rgba.size()) / 4);
  }
  return means_.emplace(image, mean).first->second;
}

Thumbnails::Shown Thumbnails::of(const std::shared_ptr<const DecodedImages>& images, int image) {
  keepTo(images);
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

Thumbnails::Shown Thumbnails::ofMaterial(const std::shared_ptr<const DecodedImages>& images,
                                         const Scene& scene, const Look& look, int material,
                                         const FitForm& form) {
  constexpr std::size_t most = 256;
  keepTo(images);
  const Material shown = effectiveMaterial(scene, look, material);
  ShadingParameters s = shown.shading;
  if (shown.colorTexture) s.color *= meanOf(shown.colorTexture->image);
  if (materialBalls_.size() > most) materialBalls_.clear();
  Ball& ball = materialBalls_[material];
  if (!ball.kept.texture || !sameBall(ball.of, s) || ball.form.blinn != form.blinn ||
      ball.form.blinnFactor != form.blinnFactor)
    ball = {s, form, kept(ballOf(s, form, 36))};
  return Thumbnails::shown(ball.kept);
}

}  // namespace glint::viewer
