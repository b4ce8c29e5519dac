#include "glint/render/environment_texture.h"

#include "glint/image/error.h"

namespace glint {

void EnvironmentTexture::upload(const std::shared_ptr<const EnvironmentImage>& image) {
  if (image == image_) return;
  const EnvironmentImage::Level& whole = image->levels[0];
  GLint limit = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
  if (whole.width > limit || whole.height > limit)
    throw InputError("--hdri-file: " + image->name + ": " + std::to_string(whole.width) + "x" +
                     std::to_string(whole.height) + " pixels exceed this driver's limit of " +
                     std::to_string(limit) + ": make the picture smaller");
  texture_ = TextureHandle::make();
  glBindTexture(GL_TEXTURE_2D, texture_.id());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  for (std::size_t i = 0; i < image->levels.size(); ++i) {
    const EnvironmentImage::Level& level = image->levels[i];
    glTexImage2D(GL_TEXTURE_2D, GLint(i), GL_RGB32F, level.width, level.height, 0, GL_RGB, GL_FLOAT,
                 level.rgb.data());
  }
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, GLint(image->levels.size() - 1));
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_REPEAT);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  image_ = image;
}

void EnvironmentTexture::bind(GLuint unit) const {
  glActiveTexture(GL_TEXTURE0 + unit);
  glBindTexture(GL_TEXTURE_2D, texture_.id());
  glBindSampler(unit, 0);
}

}  // namespace glint
