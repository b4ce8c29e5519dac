#pragma once

#include <memory>
#include <optional>

#include "glint/reference/renderer.h"
#include "glint/reference/terms.h"
#include "glint/render/renderer.h"
#include "model_loader.h"

namespace glint {

/// A picture being drawn: rows from the top, linear, premultiplied, before exposure.
class PictureSource {
 public:
  virtual ~PictureSource() = default;
  virtual glm::ivec2 size() const = 0;
  /// Draws the next rows; false if there are none left. Reuses the image if it is large enough.
  virtual bool draw(Image& rows) = 0;
  virtual const DrawList& list() const = 0;
  virtual RenderTimes times() const = 0;
  virtual int samples() const = 0;  ///< per pixel
};

/// A model ready to be drawn, by GL or, without a renderer, by the reference. The model must
/// outlive it; the model's images are moved to the driver.
class Stage {
 public:
  Stage(Renderer* renderer, LoadedModel& model);
  std::unique_ptr<PictureSource> picture(const Look& look);
  Image term(const Look& look, const PictureTerm& term);
  /// Warnings about textures that the driver could not take unchanged.
  std::vector<std::string> takeWarnings() {
    return scene_ ? scene_->takeWarnings() : std::vector<std::string>();
  }
  const LoadedModel& model() const { return model_; }

 private:
  Renderer* renderer_;
  LoadedModel& model_;
  std::optional<GpuScene> scene_;
};

}  // namespace glint
