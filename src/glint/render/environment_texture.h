#pragma once

#include <memory>

#include "glint/gl/handles.h"
#include "glint/render/environment_image.h"

namespace glint {

/// The picture of the environment in the driver's memory; the one drawn last. Lives and dies in one
/// context.
class EnvironmentTexture {
 public:
  /// Uploads the picture unless it is there. Throws InputError for one that the driver cannot hold.
  void upload(const std::shared_ptr<const EnvironmentImage>& image);
  void bind(GLuint unit) const;

 private:
  std::shared_ptr<const EnvironmentImage> image_;
  TextureHandle texture_;
};

}  // namespace glint
