#pragma once

#include <memory>
#include <optional>

#include "glint/reference/renderer.h"
#include "glint/reference/terms.h"
#include "glint/render/renderer.h"
#include "model_loader.h"

namespace glint {

/// A picture in the making: rows from the top, linear, premultiplied, before exposure.
class PictureSource {
 public:
  virtual ~PictureSource() = default;
  virtual glm::ivec2 size() const = 0;
  /// Draws the next rows; false if there are none left. The image is reused if it has room.
  virtual bool draw(Image& rows) = 0;
  virtual const DrawList& list() const = 0;
  virtual RenderTimes times() const = 0;
  virtual int samples() const = 0;  ///< a pixel
};

/// A model ready to be drawn, by GL or, where there is no renderer, by the reference. The model
/// must outlive it; its images go to the driver.
class Stage {
 public:
  Stage(Renderer* renderer, LoadedModel& model);
  std::unique_ptr<PictureSource> picture(const Look& look);
  Image term(const Look& look, const PictureTerm& term);
  /// Of textures that the driver could not take as they are.
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
