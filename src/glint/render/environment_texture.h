#pragma once

#include <memory>

#include "glint/gl/handles.h"
#include "glint/render/environment_image.h"

namespace glint {

/// The environment picture drawn last, in the driver's memory. Belongs to one context for its whole
/// lifetime.
class EnvironmentTexture {
 public:
  /// Uploads the picture unless it is there already. Throws InputError for one too large for the
  /// driver.
  void upload(const std::shared_ptr<const EnvironmentImage>& image);
  void bind(GLuint unit) const;

 private:
  std::shared_ptr<const EnvironmentImage> image_;
  TextureHandle texture_;
};

}  // namespace glint
